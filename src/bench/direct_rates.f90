module lagrangia_direct_rates
    !! The right-hand sides of `direct_rates.c`: what a user of GSL would write for the problems of
    !! the benchmark.
    use, intrinsic :: iso_c_binding, only: c_double, c_funloc, c_funptr, c_int, c_long, &
                                           c_null_funptr, c_ptr
    implicit none (type, external)
    private
    public :: direct_context_t, direct_rates

    type, bind(c) :: direct_context_t
        real(c_double) :: parameters(9) = 0.0_c_double  !! in the order of `describe`
        integer(c_long) :: evaluations = 0              !! so far
    end type direct_context_t

    ! allow(assumed-size): C gives the address of the first element
    abstract interface
        function rates_i(t, y, f, context) result(status) bind(c)
            !! As GSL's `gsl_odeiv2_system` has it.
            import :: c_double, c_int, c_ptr
            implicit none (type, external)
            real(c_double), value :: t
            real(c_double), intent(in) :: y(*)
            real(c_double), intent(inout) :: f(*)
            type(c_ptr), value :: context
            integer(c_int) :: status
        end function rates_i
    end interface

    procedure(rates_i), bind(c, name="lagrangia_rates_oscillator") :: rates_oscillator
    procedure(rates_i), bind(c, name="lagrangia_rates_pendulum") :: rates_pendulum
    procedure(rates_i), bind(c, name="lagrangia_rates_double_pendulum") :: rates_double_pendulum
    procedure(rates_i), bind(c, name="lagrangia_rates_cart_pendulum") :: rates_cart_pendulum
    procedure(rates_i), bind(c, name="lagrangia_rates_charged_particle") :: rates_charged_particle

contains

    function direct_rates(system) result(address)
        !! Of the system with this name; null where none was written.
        character(*), intent(in) :: system  !! its name
        type(c_funptr) :: address

        select case (system)
        case ("oscillator"); address = c_funloc(rates_oscillator)
        case ("pendulum"); address = c_funloc(rates_pendulum)
        case ("double_pendulum"); address = c_funloc(rates_double_pendulum)
        case ("cart_pendulum"); address = c_funloc(rates_cart_pendulum)
        case ("charged_particle"); address = c_funloc(rates_charged_particle)
        case default; address = c_null_funptr
        end select
    end function direct_rates
end module lagrangia_direct_rates
