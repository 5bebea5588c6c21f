module test_parameter_choice
    !! Which parameter a setting of a sheet means.
    use funit, only: TestMethod, TestSuite, assertEqual
    use lagrangia_description, only: description_t
    use lagrangia_parameter_choice, only: find_parameter
    implicit none (type, external)
    private
    public :: parameter_choice_suite

contains

    function parameter_choice_suite() result(suite)
        !! The tests of this module.
        type(TestSuite) :: suite

        suite = TestSuite("parameter_choice")
        call suite%addTest(TestMethod("parameters_of_settings", parameters_of_settings))
    end function parameter_choice_suite

    subroutine parameters_of_settings()
        !! `field(2)` and `field_y` are one of two; what has no such element is no parameter.
        type(description_t) :: d

        allocate (d%parameters(2))
        d%parameters(1)%name = "m"
        d%parameters(2)%name = "field"
        d%parameters(2)%count = 2
        call found("m", 1, 0)
        call found("field", 2, 0)
        call found("field(2)", 2, 2)
        call found("field_y", 2, 2)
        call found("field_z", 0, 0)  ! it has two
        call found("field_w", 0, 0)
        call found("field(b)", 0, 0)
        call found("field(", 2, 0)
    contains
        subroutine found(name, parameter, element)
            character(*), intent(in) :: name
            integer, intent(in) :: parameter, element
            integer :: is, of

            call find_parameter(d, name, is, of)
            call assertEqual(parameter, is, message="parameter "//name)
            call assertEqual(element, of, message="element "//name)
        end subroutine found
    end subroutine parameters_of_settings
end module test_parameter_choice
