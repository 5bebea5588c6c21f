/* Signals that end a program which does not catch them, by their names: the numbers differ between systems, and
   some have other meanings there. Those that a fault of the program raises itself (SIGSEGV, SIGABRT and their like)
   are not among them, nor SIGKILL, which nobody can catch. Source: signal(7), "Standard signals". */
#include <signal.h>

int lagrangia_ending(int which);

/* The number of one of them, beside those that are the same everywhere; 0 if there are fewer. */
int lagrangia_ending(int which)
{
    static const int others[] = {
        SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF,
#ifdef __linux__
#ifdef SIGIO
        SIGIO,
#endif
#ifdef SIGPWR
        SIGPWR,
#endif
#ifdef SIGSTKFLT
        SIGSTKFLT,
#endif
#endif
    };
    const int count = sizeof others / sizeof *others;
    int last = 0;

    if (which >= 1 && which <= count)
        return others[which - 1];
#ifdef SIGRTMAX
    last = SIGRTMAX;
#endif
#ifdef SIGRTMIN
    if (which > count && which - count <= last - SIGRTMIN + 1)
        return SIGRTMIN + which - count - 1;
#endif
    (void)last;
    return 0;
}
