/* What must be done before libgfortran begins, and that is before any of the program's statements: it
   reads its variables of the environment as soon as it is loaded. Where two of its standard units are
   given the same number by GFORTRAN_STDERR_UNIT and the like, it ends every program with "Internal
   Error: insert(): Duplicate key found!". The functions of .preinit_array run before those of any
   library. Source: System V ABI, "Initialization and Termination Functions". */
#include <string.h>

static void forget_units(int argc, char **argv, char **envp)
{
    char **kept = envp;

    (void)argc;
    (void)argv;
    for (; *envp != NULL; envp++)
        if (strncmp(*envp, "GFORTRAN_STD", 12) != 0)
            *kept++ = *envp;
    *kept = NULL;
}

__attribute__((section(".preinit_array"), used)) static void (*const run_first)(int, char **, char **) = forget_units;

/* A program that calls this is linked with the above. */
void lagrangia_first_of_all(void)
{
}
