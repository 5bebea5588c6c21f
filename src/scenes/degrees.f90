module lagrangia_degrees
    !! Angles are in radians. Who types 45 most probably means degrees, and is told what they are.
    use lagrangia_description, only: description_t
    use lagrangia_kinds, only: dp
    use lagrangia_number_class, only: is_nonzero
    use lagrangia_scene, only: scene_t
    use lagrangia_system, only: system_t
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: degrees_advice, degrees_in, degrees_warning

contains

    pure function degrees_advice(value, unit) result(text)
        !! `; angles are in radians: 45.0 degrees are 0.7853981633974483`, or "" where `value` is
        !! not between 7 and 360, or no angle.
        real(dp), intent(in) :: value      !! as it was typed
        character(*), intent(in) :: unit   !! `rad`: it is an angle
        character(:), allocatable :: text
        real(dp), parameter :: degree = acos(-1.0_dp)/180.0_dp

        text = ""
        if (unit /= "rad" .or. .not. (abs(value) >= 7.0_dp .and. abs(value) <= 360.0_dp)) return
        text = "; angles are in radians: "//to_text(value)//" degrees are "//to_text(value*degree)
    end function degrees_advice

    function degrees_warning(scene, system) result(text)
        !! Of the first coordinate whose start is a multiple of 5 from 10 to 360; "": none is.
        type(scene_t), intent(in) :: scene     !! says where the motion starts
        class(system_t), intent(in) :: system  !! with the scene's parameters
        character(:), allocatable :: text
        type(description_t) :: d
        integer :: i

        call system%describe(d)
        text = ""
        do i = 1, size(d%coordinates)
            text = degrees_in(scene%q(i:i), trim(d%coordinates(i)%unit))
            if (text == "") cycle
            text = trim(d%coordinates(i)%name)//" starts at "//to_text(scene%q(i))//" rad"//text
            return
        end do
    end function degrees_warning

    pure function degrees_in(values, unit) result(text)
        !! The advice about the largest of values that are all multiples of 5: a start, the ends of
        !! an axis; else "".
        real(dp), intent(in) :: values(:)  !! as they were typed
        character(*), intent(in) :: unit   !! `rad`: they are angles
        character(:), allocatable :: text

        text = ""
        if (any(is_nonzero(values - 5.0_dp*anint(values/5.0_dp)))) return
        text = degrees_advice(values(maxloc(abs(values), 1)), unit)
    end function degrees_in
end module lagrangia_degrees
