module lagrangia_integrator
    !! The contract of an integrator: `prepare` refuses or allocates, `advance` cannot fail.
    use lagrangia_description, only: line_length, name_length
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_system, only: system_t
    implicit none (type, external)
    private
    public :: integrator_t, integrator_box_t

    type, abstract :: integrator_t
        character(name_length) :: name = ""
        character(line_length) :: title = ""  !! a few words and the source
        integer :: order = 0
        integer(i8) :: evaluations = 0        !! of accelerations, since `prepare`
    contains
        procedure(prepare_i), deferred :: prepare
        procedure(advance_i), deferred :: advance
    end type integrator_t

    type :: integrator_box_t
        !! A place for one integrator of any kind.
        class(integrator_t), allocatable :: item
    end type integrator_box_t

    abstract interface
        pure subroutine prepare_i(self, system, error)
            !! Refuse a system that the method is not made for, or get ready to step it.
            import :: integrator_t, system_t, error_t
            implicit none (type, external)
            class(integrator_t), intent(inout) :: self
            class(system_t), intent(in) :: system
            type(error_t), allocatable, intent(out) :: error
        end subroutine prepare_i

        pure subroutine advance_i(self, system, t0, dt, first, steps, q, v)
            !! Take the steps `first`, ..., `first + steps - 1` of a run: step `k` starts at
            !! `t0 + k*dt`, so that a run gives the same bytes however it is cut into blocks.
            import :: integrator_t, system_t, dp, i8
            implicit none (type, external)
            class(integrator_t), intent(inout) :: self
            class(system_t), intent(in) :: system
            real(dp), intent(in) :: t0                !! time of step 0, s
            real(dp), intent(in) :: dt                !! step, s
            integer(i8), intent(in) :: first, steps
            real(dp), intent(inout) :: q(system%ndof)
            real(dp), intent(inout) :: v(system%ndof)
        end subroutine advance_i
    end interface
end module lagrangia_integrator
