module lagrangia_progress
    !! How far a long run is, on a terminal's stderr only.
    use, intrinsic :: iso_fortran_env, only: error_unit
    use lagrangia_console, only: is_terminal, show_progress
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_observer, only: observer_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: progress_t

    real(dp), parameter :: patience = 2.0_dp   !! s before anything is shown
    real(dp), parameter :: interval = 0.2_dp   !! s between two updates

    type, extends(observer_t) :: progress_t
        character(:), allocatable :: label
        integer(i8), private :: start = 0, rate = 0
        real(dp), private :: next = patience
        logical :: shown = .false.
    contains
        procedure :: observe
        procedure :: tick
        procedure :: restart
        procedure :: clear
    end type progress_t

contains

    subroutine restart(self, label)
        !! A new run begins.
        class(progress_t), intent(inout) :: self
        character(*), intent(in) :: label

        self%label = label
        self%next = patience
        self%shown = .false.
        call system_clock(self%start, self%rate)
        if (.not. is_terminal(error_unit)) self%next = huge(patience)
    end subroutine restart

    subroutine observe(self, system, t, q, v, error)
        !! The states don't matter.
        class(progress_t), intent(inout) :: self
        class(system_t), intent(in) :: system
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)
        type(error_t), allocatable, intent(out) :: error
    end subroutine observe

    subroutine tick(self, done, steps)
        !! Rewrite the line when it is time.
        class(progress_t), intent(inout) :: self
        integer(i8), intent(in) :: done, steps
        integer(i8) :: now
        real(dp) :: seconds, percent

        call system_clock(now)
        seconds = real(now - self%start, dp)/real(self%rate, dp)
        if (seconds < self%next) return
        self%next = seconds + interval
        self%shown = .true.
        percent = 100.0_dp*real(done, dp)/real(max(steps, 1_i8), dp)
        call show_progress(self%label//": "//to_text(int(percent))//" %, "// &
                           to_text(int(seconds))//" s")
    end subroutine tick

    subroutine clear(self)
        !! Remove the line, if there is one.
        class(progress_t), intent(inout) :: self

        if (self%shown) call show_progress("")
        self%shown = .false.
    end subroutine clear
end module lagrangia_progress
