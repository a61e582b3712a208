/* guard.c: calls the function of a submission, and comes back where it goes wrong. Compiled with it, never by students.
 *
 * `guarded` takes what the function takes and returns 0, or the number of the signal that would have ended the process;
 * `address` is then where in this library it was, and `full` whether the stack was. Only these are seen from outside: a
 * student's `step` is not the C library's.
 */
#define _GNU_SOURCE
#include "exercise.h"
#include <setjmp.h>
#include <signal.h>
#include <stdint.h>
#include <ucontext.h>

extern const char __ehdr_start __attribute__((visibility("hidden")));

#define SEEN __attribute__((visibility("default")))

/* So near to the end of the stack a fault is one of the stack [bytes]. */
#define NEAR 65536

SEEN uintptr_t address;
SEEN int full;
static sigjmp_buf back;
static char stack[1 << 16];

static void caught(int number, siginfo_t *info, void *given)
{
    ucontext_t *context = given;
    uintptr_t top = 0, code = 0, touched = (uintptr_t)info->si_addr;
#if defined(__x86_64__)
    code = (uintptr_t)context->uc_mcontext.gregs[REG_RIP];
    top = (uintptr_t)context->uc_mcontext.gregs[REG_RSP];
#elif defined(__aarch64__)
    code = (uintptr_t)context->uc_mcontext.pc;
    top = (uintptr_t)context->uc_mcontext.sp;
#endif
    address = code - (uintptr_t)&__ehdr_start;
    full = number == SIGSEGV && (touched < top ? top - touched : touched - top) < NEAR;
    siglongjmp(back, number);
}

static void handle(void)
{
    /* on a stack of its own: the program's may be full */
    const stack_t own = {.ss_sp = stack, .ss_size = sizeof stack};
    struct sigaction action = {.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER};
    const int numbers[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP};
    action.sa_sigaction = caught;
    sigaltstack(&own, 0);
    for (unsigned i = 0; i < sizeof numbers / sizeof *numbers; i++)
        sigaction(numbers[i], &action, 0);
}

#if EXERCISE == 1 || EXERCISE == 2
#define FUNCTION step
#define PARAMETERS double *y, double *v, double dt, const struct spring *spring
#define ARGUMENTS(own) own y, own v, own dt, own spring
struct given {
    double *y, *v, dt;
    const struct spring *spring;
};
#elif EXERCISE == 3
#define FUNCTION forces
#define PARAMETERS double x[][2], double v[][2], const struct string *string, double f[][2]
#define ARGUMENTS(own) own x, own v, own string, own f
struct given {
    double (*x)[2], (*v)[2];
    const struct string *string;
    double (*f)[2];
};
#elif EXERCISE == 4
#define FUNCTION step
#define PARAMETERS double x[][2], double v[][2], double dt, const struct string *string
#define ARGUMENTS(own) own x, own v, own dt, own string
struct given {
    double (*x)[2], (*v)[2], dt;
    const struct string *string;
};
#elif EXERCISE == 7
#define FUNCTION push_out
#define PARAMETERS int count, double x[][2], double v[][2], const struct circle *circle
#define ARGUMENTS(own) own count, own x, own v, own circle
struct given {
    int count;
    double (*x)[2], (*v)[2];
    const struct circle *circle;
};
#endif

static struct given given;

static void call(void)
{
    FUNCTION(ARGUMENTS(given.));
}

#ifdef OWN_STACK
/* On a stack between two pages that nobody can touch: who writes beyond an array on it stops there, and does not reach
 * the checker's. Programs are changed by the thousand, and some of them do. What calls the function may be overwritten,
 * so it comes back by a jump. */
#include <sys/mman.h>

#define PAGE 65536
#define STACK (1 << 22)
#define DONE 1000

static void call_and_jump(void)
{
    call();
    siglongjmp(back, DONE);
}

/* So many bytes, a page above them, and pages about both that nobody can touch. */
static char *apart(size_t size)
{
    char *room = mmap(0, size + 3 * PAGE, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    mprotect(room, PAGE, PROT_NONE);
    mprotect(room + size + 2 * PAGE, PAGE, PROT_NONE);
    return room + PAGE;
}

/* Memory that a call has asked for is given back when it is over. What nobody has written into is no number. */
#define HEAP (1 << 20)
SEEN size_t springlab_taken;

__attribute__((visibility("hidden"))) void *springlab_malloc(size_t size)
{
    static char *room;
    room = room ? room : apart(HEAP);
    if (size > HEAP - springlab_taken)
        __builtin_trap();
    char *start = room + springlab_taken;
    springlab_taken += (size + 127) / 64 * 64;
    springlab_taken = springlab_taken < HEAP ? springlab_taken : HEAP;
    return __builtin_memset(start, 255, size);
}

/* The last of what the program itself writes into (`switches.h`): beyond it is what brings it back. */
extern char springlab_tail[2 * PAGE] __attribute__((visibility("hidden")));

static void call_apart(void)
{
    static char *room;
    static ucontext_t there;
    if (room == 0) {
        room = apart(STACK);
        mprotect(springlab_tail, sizeof springlab_tail, PROT_NONE);
    }
    getcontext(&there);
    there.uc_stack.ss_sp = room;
    there.uc_stack.ss_size = STACK;
    makecontext(&there, call_and_jump, 0);
    setcontext(&there);
}
#define CALL call_apart
#else
#define CALL call
#define DONE 0
#endif

SEEN int guarded(PARAMETERS)
{
    handle();
    given = (struct given){ARGUMENTS()};
    int number = sigsetjmp(back, 1);
    if (number == 0)
        CALL();
    return number == DONE ? 0 : number;
}
