module lagrangia_progress
    !! How far a long run is, on a terminal's stderr; elsewhere one line with the time it takes.
    use lagrangia_console, only: note, rewrites_lines, show_progress
    use lagrangia_errors, only: error_t
    use lagrangia_kinds, only: dp, i8
    use lagrangia_number_text, only: scientific
    use lagrangia_observer, only: observer_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: about, pace, part_label, progress_line, progress_t

    real(dp), parameter :: patience = 2.0_dp   !! s before anything is shown
    real(dp), parameter :: interval = 0.2_dp   !! s between two updates
    real(dp), parameter :: long = 60.0_dp      !! s; a run that takes less needs no announcement

    type, extends(observer_t) :: progress_t
        character(:), allocatable :: label
        integer(i8), private :: start = 0, rate = 0
        real(dp), private :: next = patience
        logical, private :: terminal = .false.  !! else there is one line at most
        character(:), allocatable, private :: counted  !! what is done, to be shown with its rate
        integer, private :: parts = 1                  !! of what is counted, that are told
        logical :: shown = .false.
    contains
        procedure :: observe
        procedure :: tick
        procedure :: restart
        procedure :: say
        procedure :: clear
    end type progress_t

contains

    subroutine restart(self, label, quiet, counted, parts)
        !! A new run begins.
        class(progress_t), intent(inout) :: self
        character(*), intent(in) :: label       !! what runs, in one word
        logical, intent(in), optional :: quiet  !! say nothing, neither on a terminal nor off it
        character(*), intent(in), optional :: counted
        !! the plural of what is counted: its rate and the time that is left are shown too
        integer, intent(in), optional :: parts  !! of each of these that `tick` is told; else 1

        self%label = label
        self%counted = ""
        if (present(counted)) self%counted = counted
        self%parts = 1
        if (present(parts)) self%parts = parts
        self%next = patience
        self%shown = .false.
        call system_clock(self%start, self%rate)
        self%terminal = rewrites_lines()
        if (.not. present(quiet)) return
        if (quiet) self%next = huge(patience)
    end subroutine restart

    subroutine observe(self, system, t, q, v, error)
        !! The states don't matter.
        class(progress_t), intent(inout) :: self
        class(system_t), intent(in) :: system  !! with its parameters
        real(dp), intent(in) :: t, q(system%ndof), v(system%ndof)  !! s; coordinates and velocities
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
    end subroutine observe

    subroutine tick(self, done, steps)
        !! Rewrite the line when it is time, `33 %, 4 s, 8 s left`; or announce, once, how long it
        !! will be.
        class(progress_t), intent(inout) :: self
        integer(i8), intent(in) :: done, steps  !! how many of how many
        integer(i8) :: now
        real(dp) :: seconds, whole

        call system_clock(now)
        seconds = real(now - self%start, dp)/real(self%rate, dp)
        if (seconds < self%next) return
        if (.not. self%terminal) then
            if (done < 1) return
            self%next = 2.0_dp*seconds  ! it may get slower
            whole = seconds*(real(steps, dp)/real(done, dp))
            if (whole < long) return
            call note(self%label//" takes about "//about(whole))
            self%next = huge(patience)
            return
        end if
        self%next = seconds + interval
        self%shown = .true.
        call show_progress(progress_line(self%label, self%counted, seconds, done, steps, &
                                         self%parts))
    end subroutine tick

    pure function progress_line(label, counted, seconds, done, all, parts) result(text)
        !! `pendulum: 33 %, 4 s, 8 s left`; only how long it takes where `all` is not known.
        character(*), intent(in) :: label     !! what runs
        character(*), intent(in) :: counted   !! the plural of what is counted, or ""
        real(dp), intent(in) :: seconds       !! since the start, above 0
        integer(i8), intent(in) :: done, all  !! how many of how many; 0: of unknown
        integer, intent(in), optional :: parts  !! of what is counted, that these are; else 1
        character(:), allocatable :: text

        text = label//": "
        if (all > 0) text = text//to_text(int(100.0_dp*min(real(done, dp)/real(all, dp), &
                                                           1.0_dp)))//" %, "
        text = text//to_text(int(seconds))//" s"//pace(counted, seconds, done, all, parts)
    end function progress_line

    pure function part_label(command, name, number, all) result(text)
        !! `check pendulum, 2 of 14`: of work in several parts.
        character(*), intent(in) :: command, name  !! what is done, and to what
        integer, intent(in) :: number, all         !! the part that is done now, of how many
        character(:), allocatable :: text

        text = command//" "//trim(name)
        if (all > 1) text = text//", "//to_text(number)//" of "//to_text(all)
    end function part_label

    pure function pace(counted, seconds, done, all, parts) result(text)
        !! `, 5.30E+03 trajectories/s, 12 s left`; without the first where nothing is counted.
        character(*), intent(in) :: counted        !! the plural of what is counted, or ""
        real(dp), intent(in) :: seconds            !! since the start, above 0
        integer(i8), intent(in) :: done, all       !! how many of how many
        integer, intent(in), optional :: parts     !! of what is counted, that these are; else 1
        character(:), allocatable :: text
        integer :: parts_of_one

        parts_of_one = 1
        if (present(parts)) parts_of_one = parts
        text = ""
        if (done < 1 .or. done >= all) return
        if (counted /= "") text = ", "//scientific(done/(parts_of_one*seconds), 3)//" "// &
                                  counted//"/s"
        text = text//", "//about(seconds*(real(all - done, dp)/real(done, dp)))//" left"
    end function pace

    pure function about(seconds) result(text)
        !! A duration in two digits at most, of the unit that suits: `50 s`, `12 min`, `31 years`.
        real(dp), intent(in) :: seconds  !! s, not negative
        character(:), allocatable :: text
        character(7), parameter :: names(5) = ["s      ", "min    ", "h      ", "days   ", &
                                               "years  "]
        real(dp), parameter :: units(5) = [1.0_dp, 60.0_dp, 3600.0_dp, 86400.0_dp, 31557600.0_dp]
        real(dp), parameter :: highest = 1e9_dp  !! years
        integer :: i

        i = max(1, count(seconds >= 2*units))
        text = to_text(nint(min(seconds/units(i), highest)))//" "//trim(names(i))
    end function about

    subroutine say(self, words)
        !! A line, on a terminal, of work that cannot say how far it is; until `clear`.
        class(progress_t), intent(inout) :: self
        character(*), intent(in) :: words  !! what it does

        if (.not. rewrites_lines()) return
        self%shown = .true.
        call show_progress(words)
    end subroutine say

    subroutine clear(self)
        !! Remove the line, if there is one.
        class(progress_t), intent(inout) :: self

        if (self%shown) call show_progress("")
        self%shown = .false.
    end subroutine clear
end module lagrangia_progress
