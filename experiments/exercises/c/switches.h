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

/* The last of what a program writes into: pages that nobody can touch, once it is called (`guard.c`). */
__attribute__((aligned(65536), section(".bss.springlab_tail"))) char springlab_tail[2 * 65536];

/* Rounds of loops in one call: past so many it is stopped. */
#define SPRINGLAB_MOST 20000
SPRINGLAB_SEEN int springlab_rounds;

static inline void springlab_tick(void)
{
    if (++springlab_rounds > SPRINGLAB_MOST)
        __builtin_trap();
}

/* Memory that a call has asked for (`guard.c`). */
void *springlab_malloc(size_t size);

static inline void *springlab_calloc(size_t count, size_t size)
{
    if (size && count > (1 << 24) / size)
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
