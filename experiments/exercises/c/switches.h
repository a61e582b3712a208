/* switches.h: what stands before a program of which every small change can be switched on (`variants`). Compiled with
 * it, never by students.
 */
#include <stdlib.h>
#include <string.h>

#define SPRINGLAB_SEEN __attribute__((visibility("default"), unused))

/* Which variant of each place is meant, 0 for the text as it is; and whether the place was come to. */
SPRINGLAB_SEEN int springlab_at[SPRINGLAB_PLACES];
SPRINGLAB_SEEN char springlab_reached[SPRINGLAB_PLACES];
#define SPRINGLAB_AT(place) (springlab_reached[place] = 1, springlab_at[place])

/* Rounds of loops in one call: past so many it is stopped. */
#define SPRINGLAB_MOST 20000
SPRINGLAB_SEEN int springlab_rounds;

static inline void springlab_tick(void)
{
    if (++springlab_rounds > SPRINGLAB_MOST)
        __builtin_trap();
}

/* Memory that a call has asked for is given back when it is over: who writes beyond it harms nobody else. What nobody
 * has written into is no number. */
#define SPRINGLAB_ROOM (1 << 20)
SPRINGLAB_SEEN size_t springlab_taken;
static char springlab_room[SPRINGLAB_ROOM] __attribute__((aligned(16)));

static inline void *springlab_malloc(size_t size)
{
    void *start = springlab_room + springlab_taken;
    if (size > SPRINGLAB_ROOM - 256 - springlab_taken)
        __builtin_trap();
    springlab_taken += (size + 127) / 64 * 64;
    return memset(start, 255, size);
}

static inline void *springlab_calloc(size_t count, size_t size)
{
    if (size && count > SPRINGLAB_ROOM / size)
        __builtin_trap();
    return memset(springlab_malloc(count * size), 0, count * size);
}

static inline void *springlab_copied(const void *from, size_t size)
{
    return memcpy(springlab_malloc(size), from, size);
}

static inline void *springlab_realloc(void *from, size_t size)
{
    return from ? memmove(springlab_malloc(size), from, size) : springlab_malloc(size);
}

#define malloc springlab_malloc
#define calloc springlab_calloc
#define realloc springlab_realloc
#define free(pointer) ((void)(pointer))
