module lagrangia_path_maker
    !! The contract of whoever computes a path for a principle: a method by its name, a start.
    !!
    !! Principles know no integrators; they are told a path, and look at it.
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: path_maker_t

    type, abstract :: path_maker_t
    contains
        procedure(make_i), deferred :: make
    end type path_maker_t

    abstract interface
        subroutine make_i(self, method, system, t0, dt, q0, v0, q, v, error)
            !! The states at `t0`, `t0 + dt`, ... that `method` computes; the first one is
            !! `q0`, `v0`. Fails where the method is not known or refuses the system.
            import :: path_maker_t, system_t, dp, error_t
            implicit none (type, external)
            class(path_maker_t), intent(in) :: self
            character(*), intent(in) :: method
            class(system_t), intent(in) :: system
            real(dp), intent(in) :: t0, dt
            real(dp), intent(in) :: q0(system%ndof), v0(system%ndof)
            real(dp), intent(out) :: q(:, :), v(:, :)  !! (ndof, samples)
            type(error_t), allocatable, intent(out) :: error
        end subroutine make_i
    end interface
end module lagrangia_path_maker
