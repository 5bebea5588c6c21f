module lagrangia_written_formulas
    !! What the group `&lagrangian` of a scene says, as texts: names, T and V or L, and what else.
    use lagrangia_description, only: line_length, name_length, parameter_t, quantity_t
    implicit none (type, external)
    private
    public :: written_formulas_t
    public :: longest_formula

    integer, parameter :: longest_formula = 10000  !! characters of one formula

    type :: written_formulas_t
        !! A system in formulas, each as it was typed. A formula that was not given is "".
        character(name_length) :: name = ""
        character(line_length) :: title = ""
        type(quantity_t), allocatable :: coordinates(:)
        type(parameter_t), allocatable :: parameters(:)  !! with their values
        character(:), allocatable :: kinetic             !! T
        character(:), allocatable :: potential           !! V
        character(:), allocatable :: lagrangian          !! L, in place of T and V
        character(longest_formula), allocatable :: forces(:)  !! Q of each coordinate
        character(longest_formula), allocatable :: definitions(:)  !! `D = theta1 - theta2`
        character(longest_formula), allocatable :: positions(:)    !! `bob, m: x, y` or with z
        character(longest_formula), allocatable :: rotors(:)       !! `pulley, I: x/R`
        character(longest_formula), allocatable :: equilibrium(:)  !! one of each coordinate
        character(longest_formula), allocatable :: constraints(:)  !! `x^2 + y^2 = l^2`
        type(quantity_t), allocatable :: quantities(:)             !! names, units, meanings, and
        character(longest_formula), allocatable :: quantity_formulas(:)  !! `m r^2 phi_dot`
    end type written_formulas_t
end module lagrangia_written_formulas
