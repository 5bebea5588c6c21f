module lagrangia_sweep_summary
    !! What `lagrangia sweep` prints behind its work, for people and as JSON.
    use lagrangia_attractor, only: attractors_t
    use lagrangia_console, only: put_line
    use lagrangia_counted, only: counted
    use lagrangia_data_files, only: script_path
    use lagrangia_description, only: description_t
    use lagrangia_images, only: image_count
    use lagrangia_json, only: json_array, json_element, json_item, json_object, json_pair
    use lagrangia_kept, only: is_lyapunov
    use lagrangia_kinds, only: dp, i8
    use lagrangia_printed_table, only: in_digits => short
    use lagrangia_sweep, only: exponent_method, sweep_t
    use lagrangia_sweep_grid, only: sweep_result_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: put_json, put_summary

contains

    subroutine put_summary(sweep, result, path)
        !! How many, how long, and between what bounds the numbers lie.
        type(sweep_t), intent(in) :: sweep           !! that has been computed
        type(sweep_result_t), intent(in) :: result   !! what came out
        character(*), intent(in) :: path             !! of the data file
        character(:), allocatable :: how, method
        real(dp) :: largest, least
        integer(i8) :: found
        integer :: i, width

        how = " by "//to_text(result%processes)//" process"// &
              trim(merge("  ", "es", result%processes == 1))
        if (image_count() > 1) how = how//" on each of "//to_text(image_count())//" images"
        if (result%in_lanes) how = how//", in lanes"
        if (result%resumed > 0) how = how//"; "//to_text(result%resumed)//" were there already"
        method = trim(sweep%scene%method)
        if (all(is_lyapunov(sweep%kept%kind))) then
            method = exponent_method(sweep%scene)
        else if (any(is_lyapunov(sweep%kept%kind)) .and. &
                 method /= exponent_method(sweep%scene)) then
            method = method//", exponents by "//exponent_method(sweep%scene)
        end if
        call put_line(trim(sweep%scene%name)//": "//counted(sweep%trajectories(), "trajectory")// &
                      " by "//method//" in "// &
                      in_digits(result%seconds, 3)//" s"//how)
        width = maxval(len_trim(sweep%kept%text)) + 2
        do i = 1, size(sweep%kept)
            call result%range_of(i, found, least, largest)
            associate (kept => sweep%kept(i))
                if (found > 0) then
                    call put_line("  "//kept%text(:width)//shown(least)//" to "// &
                                  shown(largest)//trim(" "//unit(kept%unit))// &
                                  missing(found))
                else
                    call put_line("  "//kept%text(:width)//"none of them has it")
                end if
                if (kept%text == "attractor") call put_attractors(sweep, result%attractors)
            end associate
        end do
        call put_line("data file: "//path)
        call put_line("gnuplot script: "//script_path(path))
    contains
        pure function shown(number) result(text)
            !! Attractors are counted.
            real(dp), intent(in) :: number
            character(:), allocatable :: text

            text = in_digits(number, 6)
            if (sweep%kept(i)%text == "attractor") text = to_text(nint(number))
        end function shown

        pure function unit(text)
            character(*), intent(in) :: text
            character(:), allocatable :: unit

            unit = trim(text)
            if (text == "1") unit = ""
        end function unit

        pure function missing(found) result(text)
            integer(i8), intent(in) :: found
            character(:), allocatable :: text
            integer(i8) :: number

            text = ""
            number = sweep%trajectories() - found
            if (sweep%keeps_points) then
                text = " in "//counted(found, "point")
            else if (number > 0) then
                text = "; "//to_text(number)//" of them "// &
                       trim(merge("has ", "have", number == 1))//" none"
            end if
        end function missing
    end subroutine put_summary

    subroutine put_attractors(sweep, attractors)
        !! Where each of them is, and how many trajectories come to it.
        type(sweep_t), intent(in) :: sweep
        type(attractors_t), intent(in) :: attractors
        type(description_t) :: d
        integer, parameter :: most = 12
        integer :: i

        call sweep%system%describe(d)
        if (.not. allocated(attractors%met)) return
        do i = 1, min(most, attractors%count)
            call put_line("    "//to_text(i)//" "//attractors%place_of(i, d)//": "// &
                          counted(attractors%met(i), "trajectory"))
        end do
        if (attractors%count > most) call put_line("    and "// &
            to_text(attractors%count - most)//" more")
        if (attractors%met(0) > 0) call put_line("    0, not settled or chaotic: "// &
            counted(attractors%met(0), "trajectory"))
    end subroutine put_attractors

    subroutine put_json(sweep, result, path)
        !! The same as an object.
        type(sweep_t), intent(in) :: sweep           !! that has been computed
        type(sweep_result_t), intent(in) :: result   !! what came out
        character(*), intent(in) :: path             !! of the data file
        character(:), allocatable :: rows
        real(dp) :: largest, least
        integer(i8) :: found
        integer :: i

        rows = ""
        do i = 1, size(sweep%kept)
            call result%range_of(i, found, least, largest)
            rows = rows//json_element(json_object(json_pair("keep", trim(sweep%kept(i)%text))// &
                json_pair("unit", trim(sweep%kept(i)%unit))// &
                json_pair("found", found)// &
                json_pair("least", least)//json_pair("largest", largest)))
        end do
        call put_line(json_object(json_pair("scene", trim(sweep%scene%name))// &
            json_pair("file", path)// &
            json_item("trajectories", to_text(sweep%trajectories()))// &
            json_item("failed", to_text(result%failures))// &
            json_item("resumed", to_text(result%resumed))// &
            json_item("images", to_text(image_count()))// &
            json_item("threads", to_text(result%processes))// &
            json_pair("in_lanes", result%in_lanes)// &
            json_pair("seconds", result%seconds)// &
            json_item("kept", json_array(rows))))
    end subroutine put_json
end module lagrangia_sweep_summary
