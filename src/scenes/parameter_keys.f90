module lagrangia_parameter_keys
    !! The group of a system's parameters: what is answered to a wrong value or key.
    use lagrangia_degrees, only: degrees_advice
    use lagrangia_description, only: parameter_t, quantity_t
    use lagrangia_errors, only: error_t
    use lagrangia_namelist, only: has_key, namelist_t, refuse_unknown_keys, refuse_value
    use lagrangia_text, only: lower, to_text
    implicit none (type, external)
    private
    public :: refuse_parameter, refuse_unknown_parameters

contains

    pure subroutine refuse_parameter(tree, group, key, parameter, error)
        !! The value of a parameter is not allowed.
        type(namelist_t), intent(in) :: tree              !! of a file
        character(*), intent(in) :: group, key            !! in lower case
        type(parameter_t), intent(in) :: parameter        !! with that value
        type(error_t), allocatable, intent(out) :: error  !! status 2: says which are

        call refuse_value(tree, group, key, parameter%domain()//" is needed"// &
                          degrees_advice(parameter%value(1), trim(parameter%unit)), error)
    end subroutine refuse_parameter

    pure subroutine refuse_unknown_parameters(tree, group, names, coordinates, shown_by, remark, &
                                              error)
        !! Refuse a key that is no parameter; of a coordinate or a velocity it says which key of
        !! `&scene` starts it.
        type(namelist_t), intent(in) :: tree              !! of a file
        character(*), intent(in) :: group                 !! in lower case
        character(*), intent(in) :: names(:)              !! of the parameters, in lower case
        type(quantity_t), intent(in) :: coordinates(:)    !! of the system
        character(*), intent(in) :: shown_by              !! the command that shows all parameters
        character(*), intent(in) :: remark                !! behind what is said of another key
        type(error_t), allocatable, intent(out) :: error  !! status 2
        character(:), allocatable :: name
        integer :: i

        do i = 1, size(coordinates)
            name = lower(trim(coordinates(i)%name))
            if (any(names == name)) cycle
            if (has_key(tree, group, name)) then
                call refuse_value(tree, group, name, "is a coordinate; its start is "// &
                                  start_of("q", i), error)
            else if (has_key(tree, group, name//"_dot")) then
                call refuse_value(tree, group, name//"_dot", "is a velocity; its start is "// &
                                  start_of("v", i), error)
            end if
            if (allocated(error)) return
        end do
        call refuse_unknown_keys(tree, group, names, error, shown_by=shown_by)
        if (allocated(error)) error%message = error%message//remark
    end subroutine refuse_unknown_parameters

    pure function start_of(key, i) result(text)
        !! `q(2) of &scene, as in --set 'scene%q(2)=0.5'`.
        character(*), intent(in) :: key  !! `q` or `v`
        integer, intent(in) :: i         !! the coordinate
        character(:), allocatable :: text

        text = key//"("//to_text(i)//")"
        text = text//" of &scene, as in --set 'scene%"//text//"=0.5'"
    end function start_of
end module lagrangia_parameter_keys
