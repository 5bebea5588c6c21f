/* How wide is a terminal? C's ioctl is variadic, which Fortran cannot call. */
#include <sys/ioctl.h>
#include <unistd.h>

int lagrangia_terminal_columns(int descriptor);

/* Columns of the terminal behind it, 0 where it does not say; -1 if there is no terminal. */
int lagrangia_terminal_columns(int descriptor)
{
    struct winsize size = {0};

    if (!isatty(descriptor))
        return -1;
    if (ioctl(descriptor, TIOCGWINSZ, &size) != 0)
        return 0;
    return size.ws_col;
}
