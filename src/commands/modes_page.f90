module lagrangia_modes_page
    !! Small oscillations as `lagrangia modes` prints them: for the eye, with the digits that
    !! rounding has left, or as JSON.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_certain_digits, only: certain, number, share_of
    use lagrangia_console, only: put, put_line
    use lagrangia_damped_rates, only: damped_rates
    use lagrangia_description, only: description_t
    use lagrangia_equilibrium, only: place_text
    use lagrangia_errors, only: error_t
    use lagrangia_json, only: json_array, json_element, json_item, json_list, json_object, &
                              json_pair, json_string
    use lagrangia_kinds, only: dp
    use lagrangia_mode_rounding, only: find_rounding, mode_rounding_t
    use lagrangia_number_class, only: is_nonzero, is_zero
    use lagrangia_number_text, only: scientific
    use lagrangia_small_oscillations, only: is_oscillation, is_unstable, modes_t, twin_of
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: print_modes, put_json

    character(16), parameter :: labels(3) = [character(16) :: &
        "oscillation", "zero mode", "unstable"]
    real(dp), parameter :: pi = acos(-1.0_dp)
    integer, parameter :: widest = 8  !! matrices beyond are not printed

contains

    subroutine print_modes(system, modes)
        !! For the eye: twelve digits, and differences.
        class(system_t), intent(in) :: system  !! with its parameters
        type(modes_t), intent(in) :: modes     !! of it, solved
        type(description_t) :: d
        type(mode_rounding_t) :: rounding
        real(dp) :: share  !! of omega^2, that rounding may have changed; all of what is 0
        character(140) :: row
        integer :: j, k, n

        call system%describe(d)
        call find_rounding(system, modes, rounding)
        n = size(modes%omega2)
        call put_line(trim(d%name)//": small oscillations about "//place_text(d, modes%at))
        if (n <= widest) then
            call put_matrix("M", modes%mass)
            call put_matrix("K", modes%stiffness, rounding%springs)
            if (any(is_nonzero(modes%gyroscopic))) call put_matrix("G", modes%gyroscopic)
        end if
        if (allocated(modes%basis)) call put_constraints(modes)
        if (modes%difference >= 0.0_dp) then
            call put_line("page against L's second derivatives, relative: "// &
                          short(modes%difference))
        else if (allocated(modes%analytic%mass)) then
            call put_line("page not compared with L's second derivatives: too many coordinates")
        else
            call put_line("M and K come from L's second derivatives: the page has none")
        end if
        call put_line("")
        call put_line("omega^2 [s^-2]     omega [rad/s]      f [Hz]             T [s]         "// &
                      "     closed form        differ   what")
        do j = 1, n
            share = rounding%squares(j)
            if (is_nonzero(modes%omega2(j))) share = share/abs(modes%omega2(j))
            row = certain(modes%omega2(j), share)
            if (modes%label(j) == is_oscillation) then
                associate (w => modes%omega(j))
                    row(20:) = certain(w, 0.5_dp*share)
                    row(39:) = certain(w/(2.0_dp*pi), 0.5_dp*share)
                    row(58:) = certain(2.0_dp*pi/w, 0.5_dp*share)
                end associate
            else if (modes%label(j) == is_unstable) then
                row(20:) = "growth rate "//certain(sqrt(-modes%omega2(j)), 0.5_dp*share)//" 1/s"
                if (modes%turning(j) > 0.0_dp) then
                    row(:19) = "complex"
                    row(50:) = "turns by "//trim(number(modes%turning(j)))//" rad/s"
                end if
            end if
            if (allocated(modes%analytic%omega2)) then
                row(77:) = certain(modes%analytic%omega2(j), share)
                row(96:) = short(relative(modes, j))
            end if
            row(105:) = labels(modes%label(j))
            if (is_zero(modes%omega2(j)) .and. &
                share > 1e-24_dp*maxval(abs(modes%omega2))) row(len_trim(row) + 1:) = &
                ", omega below "//short(sqrt(share))//" rad/s"
            call put_line(trim(row))
        end do
        do j = 2, n
            k = twin_of(modes, j)
            if (k > 0) then
                call put_line("modes "//to_text(k)//" and "//to_text(j)//" have one "// &
                              "omega and one shape; the other motion grows as t")
            else if (rounding%alike(j) > 0 .and. n <= widest) then
                call put_line("modes "//to_text(rounding%alike(j))//" and "//to_text(j)// &
                              " have one omega: every sum of their shapes is a shape, too")
            end if
        end do
        if (system%nonconservative .and. n <= widest) call put_damped(system, modes, &
                                                                           rounding%springs)
        if (n <= widest) then
            call put_line("")
            call put_shapes(modes, rounding)
        end if
        if (allocated(modes%quadrature)) then
            row = ", residual/(n eps size of its terms) = "
        else
            row = ", |K Z - M Z L|/(|K| |Z| n eps) = "
        end if
        row = "LAPACK: "//trim(modes%method)//trim(row)//" "//short(modes%ratio)
        call put_line(trim(row))
    end subroutine print_modes

    subroutine put_constraints(modes)
        !! How many directions are left, and the multipliers of the forces of constraint.
        type(modes_t), intent(in) :: modes
        character(:), allocatable :: text
        integer :: k, left

        left = size(modes%basis, 2)
        text = "constraints leave "//to_text(left)//" of "//to_text(size(modes%at))// &
               " directions; K is with their forces:"
        do k = 1, size(modes%multipliers)
            text = text//" lambda"//to_text(k)//" = "//trim(number(modes%multipliers(k)))
            if (k < size(modes%multipliers)) text = text//","
        end do
        call put_line(text)
    end subroutine put_constraints

    subroutine put_damped(system, modes, springs)
        !! What the drag makes of the modes: decay rates and frequencies.
        class(system_t), intent(in) :: system
        type(modes_t), intent(in) :: modes
        real(dp), intent(in) :: springs(:, :)  !! how far parameters may have moved K
        complex(dp), allocatable :: lambda(:)
        real(dp), allocatable :: rounding(:), distance(:)
        type(error_t), allocatable :: error
        integer :: j

        call put_line("these modes are without the generalised forces beside L; with them, as "// &
                      "exp(lambda t):")
        call damped_rates(system, modes, lambda, error, rounding, distance, springs)
        if (allocated(error)) then
            call put_line("  "//error%message)
            return
        end if
        do j = 1, size(lambda)
            associate (gamma => -real(lambda(j)), omega => aimag(lambda(j)))
                if (omega > 0.0_dp) then
                    call put_line("  decay rate "//decay(gamma, rounding(j), omega)// &
                                  " 1/s, omega "//certain(omega, share_of(omega, distance(j)))// &
                                  " rad/s")
                else
                    call put_line("  decay rate "//decay(gamma, distance(j), abs(gamma))// &
                                  " 1/s, no oscillation")
                end if
            end associate
        end do
    end subroutine put_damped

    pure function decay(gamma, delta, omega) result(text)
        !! A 0 that rounding may have made is none where \(\delta > 10^{-10}\omega\).
        real(dp), intent(in) :: gamma, delta  !! of a mode, and how far it may be off
        real(dp), intent(in) :: omega         !! its frequency
        character(:), allocatable :: text

        if (delta < 0.5_dp*abs(gamma) .or. (is_zero(gamma) .and. delta <= 1e-10_dp*omega)) then
            text = certain(gamma, share_of(gamma, delta))
        else
            text = "below "//scientific(delta, 1)
        end if
    end function decay

    subroutine put_shapes(modes, rounding)
        !! One a line; of a mode that turns, what goes as \(\sin\omega t\) on a second line.
        type(modes_t), intent(in) :: modes
        type(mode_rounding_t), intent(in) :: rounding
        real(dp) :: least
        integer :: j

        least = 4.0_dp*epsilon(least)
        if (allocated(modes%quadrature)) then
            least = 16*size(modes%omega2)*epsilon(least)  ! of a matrix that is not symmetric
            call put_line("shapes (a + i b) exp(i omega t), a and b a line each, u^+ M u = 1")
        else
            call put_line("shapes, one a line, u^T M u = 1")
        end if
        do j = 1, size(modes%omega2)
            call put_shape("", modes%shapes(:, j), rounding%shapes(:, j))
            if (allocated(modes%quadrature)) then
                call put_shape("i", modes%quadrature(:, j), rounding%shapes(:, j))
            end if
        end do
    contains
        subroutine put_shape(mark, u, delta)
            character(*), intent(in) :: mark
            real(dp), intent(in) :: u(:), delta(:)
            character(19*size(u) + 2) :: row
            integer :: i

            row = mark
            do i = 1, size(u)
                row(19*i - 16:) = certain(u(i), share_of(u(i), delta(i)))
                ! beside the others of the same weight it is rounding
                if (abs(u(i))*sqrt(modes%mass(i, i)) < least .or. &
                    abs(u(i)) <= 2.0_dp*delta(i)) row(19*i - 16:) = "0"
            end do
            call put_line(trim(row))
        end subroutine put_shape
    end subroutine put_shapes

    pure function relative(modes, j) result(difference)
        !! Of mode `j` from its closed form.
        type(modes_t), intent(in) :: modes
        integer, intent(in) :: j
        real(dp) :: difference

        associate (omega2 => modes%analytic%omega2(j))
            difference = abs(modes%omega2(j) - omega2)
            if (is_nonzero(omega2)) difference = difference/abs(omega2)
        end associate
    end function relative

    subroutine put_matrix(name, a, delta)
        !! Row by row.
        character(*), intent(in) :: name
        real(dp), intent(in) :: a(:, :)
        real(dp), intent(in), optional :: delta(:, :)  !! how far it may be off
        character(18) :: entry
        character(:), allocatable :: row
        integer :: i, j

        do i = 1, size(a, 1)
            row = "    "
            if (i == 1) row = name//" = "
            do j = 1, size(a, 2)
                entry = number(a(i, j))
                if (present(delta)) entry = certain(a(i, j), share_of(a(i, j), delta(i, j)))
                row = row//entry//" "
            end do
            call put_line(trim(row))
        end do
    end subroutine put_matrix

    pure function short(value) result(text)
        !! Two digits.
        real(dp), intent(in) :: value
        character(:), allocatable :: text

        text = scientific(value, 2)
        if (is_zero(value)) text = "0"
    end function short

    subroutine put_json(name, system, modes)
        !! One object, but for its closing brace; shapes are rows, one a mode. An unstable mode has
        !! no omega: `null`. `omega2_rounding` is how far rounding may have moved omega2. Where
        !! velocities bend the motion there are `G` and the shapes' imaginary parts besides, and of
        !! modes that turn while they grow `turning`, rad/s, but no omega2; with generalised forces
        !! beside L, `damped`: the exponents of \(e^{\lambda t}\), their decay rates and
        !! frequencies.
        character(*), intent(in) :: name         !! of the system
        class(system_t), intent(in) :: system    !! with its parameters
        type(modes_t), intent(in) :: modes       !! of it, solved
        type(mode_rounding_t) :: rounding
        complex(dp), allocatable :: lambda(:)
        real(dp), allocatable :: omega2(:)
        type(error_t), allocatable :: error
        character(:), allocatable :: text
        integer :: j

        text = json_object(json_pair("system", name)//json_item("at", json_list(modes%at)))
        call put(text(:len(text) - 1))
        call put_rows("M", modes%mass)
        call put_rows("K", modes%stiffness)
        text = ""
        do j = 1, size(modes%label)
            text = text//json_element(json_string(labels(modes%label(j))))
        end do
        call find_rounding(system, modes, rounding)
        omega2 = modes%omega2
        where (modes%turning > 0.0_dp) omega2 = ieee_value(0.0_dp, ieee_quiet_nan)
        call put(json_item("omega2", json_list(omega2))// &
                 json_item("omega2_rounding", json_list(rounding%squares))// &
                 json_item("omega", json_list(modes%omega))//json_item("label", json_array(text)))
        call put_rows("shapes", transpose(modes%shapes))
        text = "null"
        if (allocated(modes%analytic%omega2)) text = json_list(modes%analytic%omega2)
        call put(json_item("closed_form", text))
        if (allocated(modes%multipliers)) call put(json_item("multipliers", &
                                                             json_list(modes%multipliers)))
        call put(json_pair("residual_ratio", modes%ratio))
        if (system%nonconservative .and. size(modes%at) <= widest) then
            call damped_rates(system, modes, lambda, error)
            if (.not. allocated(error)) call put(json_item("damped", json_object( &
                json_item("decay_rate", json_list(-real(lambda)))// &
                json_item("omega", json_list(aimag(lambda))))))
        end if
        if (.not. allocated(modes%quadrature)) return
        call put_rows("G", modes%gyroscopic)
        call put_rows("shapes_imaginary", transpose(modes%quadrature))
        if (any(modes%turning > 0.0_dp)) call put(json_item("turning", json_list(modes%turning)))
    end subroutine put_json

    subroutine put_rows(key, a)
        !! A member that is a list of lists, row by row: all in one text would be as large as many
        !! matrices.
        character(*), intent(in) :: key  !! of the member
        real(dp), intent(in) :: a(:, :)  !! a row of it is a list
        integer :: i

        call put(json_item(key, "["))
        do i = 1, size(a, 1)
            if (i > 1) call put(", ")
            call put(json_list(a(i, :)))
        end do
        call put("]")
    end subroutine put_rows
end module lagrangia_modes_page
