module lagrangia_modes_command
    !! `lagrangia modes SYSTEM`: small oscillations, LAPACK's answer beside the page's. A scene's
    !! name or path stands for its system.
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    use lagrangia_certain_digits, only: certain, number, rounding_of
    use lagrangia_changed_scene, only: make_own_name
    use lagrangia_command_line, only: command_line_t
    use lagrangia_console, only: note, put, put_line
    use lagrangia_damped_rates, only: damped_rates
    use lagrangia_data_files, only: data_path
    use lagrangia_degrees, only: degrees_in
    use lagrangia_description, only: description_t, figure_length
    use lagrangia_equilibrium, only: missed_text, place_text
    use lagrangia_errors, only: error_t, fail
    use lagrangia_interrupt, only: interrupt_status
    use lagrangia_json, only: json_array, json_element, json_item, json_list, json_object, &
                              json_pair, json_string
    use lagrangia_kinds, only: dp, i8
    use lagrangia_mode_picture, only: has_positions, mode_picture_path, write_mode_picture
    use lagrangia_mode_script, only: part_of_modes
    use lagrangia_modes_files, only: claim_modes, prepare_modes, write_mode
    use lagrangia_modes_film, only: animate_modes
    use lagrangia_number_class, only: is_nonzero, is_zero
    use lagrangia_number_list, only: read_numbers
    use lagrangia_number_text, only: scientific
    use lagrangia_output_file, only: refuse_unwritable
    use lagrangia_output_options, only: is_told, show_picture, take_folder, take_picture
    use lagrangia_progress, only: progress_t
    use lagrangia_scene_keys, only: refuse_output
    use lagrangia_scene_reader, only: read_named_system
    use lagrangia_small_oscillations, only: find_modes, is_oscillation, is_unstable, &
                                            likely_equilibrium, modes_t, twin_of
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: modes_command

    character(16), parameter :: labels(3) = [character(16) :: &
        "oscillation", "zero mode", "unstable"]
    real(dp), parameter :: pi = acos(-1.0_dp)
    integer, parameter :: widest = 8  !! matrices beyond are not printed
    integer, parameter :: many = 300  !! more modes take a second and longer

contains

    subroutine modes_command(line, error)
        !! Find, print, and with `--output` write one data file a mode and their picture as the
        !! mechanism, which `--plot` lets gnuplot draw. Without `--at` another
        !! equilibrium that the page knows is shown as well.
        type(command_line_t), intent(in) :: line  !! what was typed
        type(error_t), allocatable, intent(out) :: error  !! allocated where it fails
        class(system_t), allocatable :: system
        type(description_t) :: d
        type(modes_t) :: modes, others
        type(progress_t) :: progress
        real(dp), allocatable :: at(:)
        character(:), allocatable :: advice, folder, kind, label, name, page, stem
        character(:), allocatable :: source, title, warning
        character(figure_length), allocatable :: figure(:)
        logical :: elsewhere
        integer :: j

        if (size(line%arguments) == 0) then
            call fail(error, "modes of what? 'lagrangia list systems' shows the names")
            return
        end if
        call take_folder(line, folder, error)
        if (allocated(error)) return
        call take_picture(line, kind, error)
        if (allocated(error)) return
        call read_named_system(line%arguments(1)%text, line%values_of("set"), system, error, &
                               figure, label, source)
        if (allocated(error)) return
        call system%describe(d)
        allocate (at, source=likely_equilibrium(system))
        if (line%has("at")) call read_numbers("--at", line%value_of("at", ""), at, error)
        if (allocated(error)) return
        if (line%has("plot") .and. .not. has_positions(system)) call fail(error, "no picture "// &
            "of the modes of "//trim(d%name)//": it does not say where its masses are (positions)")
        if (allocated(error)) return
        name = label
        call make_own_name(name, line%values_of("set"), (d%parameters%name), &
                           line%value_of("at", ""), title)
        stem = data_path(folder, name//"_modes.html", "text")
        page = stem
        stem = stem(:len(stem) - len("_modes.html"))
        if (line%has("output") .or. line%has("plot") .or. line%has("animate")) then
            call refuse_output(label, error)
            if (.not. allocated(error)) call claim_modes(system, stem, source, error)
            if (allocated(error)) return
        end if
        if (line%has("output") .or. line%has("plot")) then
            call prepare_modes(system, stem, warning, error)
            if (allocated(error)) return
            if (warning /= "" .and. .not. line%has("quiet")) call note(warning)
        end if
        if (line%has("animate")) call refuse_unwritable(page, error)
        if (allocated(error)) return
        if (system%ndof > many .and. .not. line%has("quiet")) call progress%say(trim(d%name)// &
            ": "//to_text(system%ndof)//" modes, some seconds")
        call find_modes(system, at, line%has("at"), modes, error)
        call progress%clear()
        if (allocated(error)) then
            if (allocated(error%key) .and. .not. line%has("at")) error%message = error%message// &
                "; '--at' says where, or equilibrium in &lagrangian"
            do j = 1, min(size(at), size(d%coordinates))
                advice = degrees_in(at(j:j), trim(d%coordinates(j)%unit))
                if (advice == "") cycle
                error%message = error%message//advice
                exit
            end do
            return
        end if
        if (d%named_in_scene .and. allocated(d%equilibrium) .and. .not. line%has("at") .and. &
            .not. line%has("quiet")) then
            if (missed_text(d, at, modes%at) /= "") call note(missed_text(d, at, modes%at))
        end if
        elsewhere = allocated(modes%analytic%elsewhere) .and. .not. line%has("at")
        if (elsewhere) call find_modes(system, modes%analytic%elsewhere, .true., others, error)
        if (allocated(error)) return
        if (line%has("json")) then
            call put_json(trim(d%name), system, modes)
            if (elsewhere) call put(', "elsewhere": ')
            if (elsewhere) call put_json(trim(d%name), system, others)
            call put_line(repeat("}", merge(2, 1, elsewhere)))
        else if (.not. line%has("quiet")) then
            call print_modes(system, modes)
            if (elsewhere) call put_line("")
            if (elsewhere) call print_modes(system, others)
        end if
        if (line%has("animate")) call animate_modes(system, figure, modes, page, title, error)
        if (line%has("animate") .and. is_told(line) .and. .not. allocated(error)) then
            call put_line("film: "//page)
        end if
        if (allocated(error)) return
        if (elsewhere .and. is_told(line) .and. (line%has("output") .or. line%has("plot") .or. &
                                                 line%has("animate"))) then
            call put_line("files are of the first equilibrium; those of the other: --at "// &
                          numbers_of(modes%analytic%elsewhere))
        end if
        if (.not. (line%has("output") .or. line%has("plot"))) return
        call progress%restart(line%arguments(1)%text, line%has("quiet"))
        do j = 1, size(modes%omega2)
            call write_mode(system, modes, j, stem, title, error)
            if (allocated(error) .or. interrupt_status() /= 0) exit
            call progress%tick(int(j, i8), size(modes%omega2, kind=i8))
        end do
        call progress%clear()
        if (allocated(error) .or. interrupt_status() /= 0) return
        if (is_told(line)) call put_line("data files and gnuplot scripts: "//folder)
        if (.not. has_positions(system)) return
        call write_mode_picture(system, figure, modes, stem, title, error)
        if (part_of_modes(modes) /= "" .and. is_told(line) .and. .not. allocated(error)) then
            call put_line("the picture has "//part_of_modes(modes))
        end if
        if (allocated(error) .or. .not. line%has("plot")) return
        call show_picture(mode_picture_path(stem), kind, line, error)
    end subroutine modes_command

    subroutine print_modes(system, modes)
        !! For the eye: twelve digits, and differences.
        class(system_t), intent(in) :: system
        type(modes_t), intent(in) :: modes
        type(description_t) :: d
        real(dp) :: share  !! of omega^2, that rounding may have changed; all of what is 0
        character(140) :: row
        integer :: j, k, n

        call system%describe(d)
        n = size(modes%omega2)
        call put_line(trim(d%name)//": small oscillations about "//place_text(d, modes%at))
        if (n <= widest) then
            call put_matrix("M", modes%mass)
            call put_matrix("K", modes%stiffness)
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
            share = rounding_of(modes, j)
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
                row(77:) = number(modes%analytic%omega2(j))
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
            if (k > 0) call put_line("modes "//to_text(k)//" and "//to_text(j)//" have one "// &
                                     "omega and one shape; the other motion grows as t")
        end do
        if (system%nonconservative .and. n <= widest) call put_damped(system, modes)
        if (n <= widest) then
            call put_line("")
            call put_shapes(modes)
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

    subroutine put_damped(system, modes)
        !! What the drag makes of the modes: decay rates and frequencies.
        class(system_t), intent(in) :: system
        type(modes_t), intent(in) :: modes
        complex(dp), allocatable :: lambda(:)
        real(dp), allocatable :: rounding(:)
        type(error_t), allocatable :: error
        integer :: j

        call put_line("these modes are without the generalised forces beside L; with them, as "// &
                      "exp(lambda t):")
        call damped_rates(system, modes, lambda, error, rounding)
        if (allocated(error)) then
            call put_line("  "//error%message)
            return
        end if
        do j = 1, size(lambda)
            associate (gamma => -real(lambda(j)), omega => aimag(lambda(j)), delta => rounding(j))
                if (omega > 0.0_dp) then
                    call put_line("  decay rate "//decay(gamma, delta, omega)//" 1/s, omega "// &
                                  certain(omega, (delta/omega)**2)//" rad/s")
                else
                    call put_line("  decay rate "//trim(number(gamma))//" 1/s, no oscillation")
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
            text = certain(gamma, delta/max(abs(gamma), tiny(gamma)))
        else
            text = "below "//scientific(delta, 1)
        end if
    end function decay

    subroutine put_shapes(modes)
        !! One a line; of a mode that turns, what goes as \(\sin\omega t\) on a second line.
        type(modes_t), intent(in) :: modes
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
            call put_shape("", modes%shapes(:, j))
            if (allocated(modes%quadrature)) call put_shape("i", modes%quadrature(:, j))
        end do
    contains
        subroutine put_shape(mark, u)
            character(*), intent(in) :: mark
            real(dp), intent(in) :: u(:)
            character(19*size(u) + 2) :: row
            integer :: i

            row = mark
            do i = 1, size(u)
                row(19*i - 16:) = number(u(i))
                ! beside the others of the same weight it is rounding
                if (abs(u(i))*sqrt(modes%mass(i, i)) < least) row(19*i - 16:) = "0"
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

    pure function numbers_of(at) result(text)
        !! As `--at` takes them.
        real(dp), intent(in) :: at(:)
        character(:), allocatable :: text
        integer :: i

        text = to_text(at(1))
        do i = 2, size(at)
            text = text//","//to_text(at(i))
        end do
    end function numbers_of

    subroutine put_matrix(name, a)
        !! Row by row.
        character(*), intent(in) :: name
        real(dp), intent(in) :: a(:, :)
        character(:), allocatable :: row
        integer :: i, j

        do i = 1, size(a, 1)
            row = "    "
            if (i == 1) row = name//" = "
            do j = 1, size(a, 2)
                row = row//number(a(i, j))//" "
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
        !! no omega: `null`. Where velocities bend the motion there are `G` and the shapes'
        !! imaginary parts besides, and of modes that turn while they grow `turning`, rad/s, but no
        !! omega2; with generalised forces beside L, `damped`: the exponents of
        !! \(e^{\lambda t}\), their decay rates and frequencies.
        character(*), intent(in) :: name
        class(system_t), intent(in) :: system
        type(modes_t), intent(in) :: modes
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
        omega2 = modes%omega2
        where (modes%turning > 0.0_dp) omega2 = ieee_value(0.0_dp, ieee_quiet_nan)
        call put(json_item("omega2", json_list(omega2))// &
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
end module lagrangia_modes_command
