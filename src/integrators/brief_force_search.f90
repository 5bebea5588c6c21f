module lagrangia_brief_force_search
    !! What long steps would go over without a sign, in an own system's formulas: when functions of
    !! the time act for a moment or turn at once is known before the first step; which functions of
    !! the coordinates act in one place only is known, and each step is to be tried.
    use lagrangia_brief_forces, only: brief_forces_t
    use lagrangia_kinds, only: dp
    use lagrangia_lagrangian_system, only: lagrangian_system_t
    use lagrangia_place_functions, only: place_functions_t
    use lagrangia_system, only: system_t
    use lagrangia_time_functions, only: kink, peak, time_functions_t
    implicit none (type, external)
    private
    public :: find_brief_forces, find_place_functions

    integer, parameter :: looks = 2000  !! times at which arguments of functions are looked at

contains

    pure subroutine find_brief_forces(system, t0, t_end, brief)
        !! The moments of a motion: of each function about the zeros of its argument, or the maxima,
        !! as far as they are apart by more than a part in `looks` of the motion.
        class(system_t), intent(in) :: system      !! with its parameters
        real(dp), intent(in) :: t0, t_end          !! start and end of the motion, s
        type(brief_forces_t), intent(out) :: brief !! these moments

        select type (system)
        class is (lagrangian_system_t)
            if (.not. allocated(system%time_functions%kinds)) return
            if (size(system%time_functions%kinds) == 0 .or. t_end >= huge(t_end)) return
            if (.not. (t_end - t0)/looks > spacing(max(abs(t0), abs(t_end)))) return
            call look_along(brief, system%time_functions, size(system%time_functions%kinds), t0, &
                            t_end)
        end select
    end subroutine find_brief_forces

    pure subroutine find_place_functions(system, functions)
        !! Those of its formulas, if it has any.
        class(system_t), intent(in) :: system                !! with its parameters
        type(place_functions_t), intent(out) :: functions    !! none where nothing is known

        select type (system)
        class is (lagrangian_system_t)
            functions = system%place_functions
        end select
    end subroutine find_place_functions

    pure subroutine look_along(brief, functions, n, t0, t_end)
        !! From one look before the start to one behind the end: what is 0 there is no sign.
        type(brief_forces_t), intent(inout) :: brief
        type(time_functions_t), intent(in) :: functions
        integer, intent(in) :: n
        real(dp), intent(in) :: t0, t_end
        real(dp), dimension(n) :: now, before
        real(dp) :: t, t_before, ulp
        integer :: i, k

        ulp = spacing(max(abs(t0), abs(t_end)))
        t_before = t0
        before = 0.0_dp
        do i = -1, looks + 1
            t = t0 + i*((t_end - t0)/looks)
            call signs_at(functions, t, now)
            do k = 1, n
                if (before(k) > 0.0_dp .and. now(k) <= 0.0_dp .or. &
                    before(k) < 0.0_dp .and. now(k) >= 0.0_dp .and. &
                    functions%kinds(k) /= peak) then
                    call add_moment(brief, functions, n, k, t_before, t, before(k), ulp)
                end if
            end do
            before = now
            t_before = t
        end do
    end subroutine look_along

    pure subroutine signs_at(functions, t, signs)
        !! What changes its sign at a moment: the argument, or at a peak its slope.
        type(time_functions_t), intent(in) :: functions
        real(dp), intent(in) :: t
        real(dp), intent(out) :: signs(:)
        real(dp), dimension(size(signs)) :: values, slopes

        call functions%arguments_at(t, values, slopes)
        signs = merge(slopes, values, functions%kinds == peak)
    end subroutine signs_at

    pure subroutine add_moment(brief, functions, n, k, t_before, t_behind, before, ulp)
        !! That of function `k` between two times, by bisection.
        type(brief_forces_t), intent(inout) :: brief
        type(time_functions_t), intent(in) :: functions
        integer, intent(in) :: n, k
        real(dp), intent(in) :: t_before, t_behind  !! s
        real(dp), intent(in) :: before              !! what changes its sign, at the former
        real(dp), intent(in) :: ulp                 !! of the times, s
        real(dp), dimension(n) :: middle
        real(dp) :: a, b, t
        integer :: i

        a = t_before
        b = t_behind
        do i = 1, digits(a)
            t = a + 0.5_dp*(b - a)
            call signs_at(functions, t, middle)
            if (middle(k)*before > 0.0_dp) then
                a = t
            else
                b = t
            end if
        end do
        if (functions%kinds(k) == kink) then
            call brief%add(b, ulp, kink=.true.)
        else
            call brief%add(b, width_of(functions, n, k, b, looks*(t_behind - t_before), ulp), &
                           kink=.false.)
        end if
    end subroutine add_moment

    pure function width_of(functions, n, k, t, far, near) result(width)
        !! Of function `k` about a moment: the first \(2^j\) times `near` at which, to one side, the
        !! argument of a switch has changed by 1, or that of a peak by 1/2; if not beyond `far`.
        type(time_functions_t), intent(in) :: functions
        integer, intent(in) :: n, k
        real(dp), intent(in) :: t, far, near  !! s
        real(dp) :: width
        real(dp), dimension(n) :: here, before, behind, slopes
        real(dp) :: change

        change = merge(0.5_dp, 1.0_dp, functions%kinds(k) == peak)
        call functions%arguments_at(t, here, slopes)
        width = near
        do while (width < far)
            call functions%arguments_at(t - width, before, slopes)
            call functions%arguments_at(t + width, behind, slopes)
            if (.not. max(abs(before(k) - here(k)), abs(behind(k) - here(k))) < change) exit
            width = 2.0_dp*width
        end do
    end function width_of
end module lagrangia_brief_force_search
