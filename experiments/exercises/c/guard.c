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

#define GUARD(function, ...)                \
    {                                       \
        handle();                           \
        int number = sigsetjmp(back, 1);    \
        if (number == 0)                    \
            function(__VA_ARGS__);          \
        return number;                      \
    }

#if EXERCISE == 1 || EXERCISE == 2
SEEN int guarded(double *y, double *v, double dt, const struct spring *spring)
GUARD(step, y, v, dt, spring)
#elif EXERCISE == 3
SEEN int guarded(double x[][2], double v[][2], const struct string *string, double f[][2])
GUARD(forces, x, v, string, f)
#elif EXERCISE == 4
SEEN int guarded(double x[][2], double v[][2], double dt, const struct string *string)
GUARD(step, x, v, dt, string)
#elif EXERCISE == 7
SEEN int guarded(int count, double x[][2], double v[][2], const struct circle *circle)
GUARD(push_out, count, x, v, circle)
#endif
