module lagrangia_formula_code
    !! What a compiled formula does: instructions on registers, one after the other.
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: code_t, instruction_t
    public :: op_add, op_divide, op_function, op_input, op_multiply, op_multiply_add, &
              op_multiply_subtract, op_negate, op_number, op_power, op_product, op_sin_cos, &
              op_subtract, op_subtract_product, op_whole_power

    integer, parameter :: op_number = -1, op_input = 0  !! registers that are filled beforehand
    integer, parameter :: op_add = 1                    !! a + b
    integer, parameter :: op_subtract = 2               !! a - b
    integer, parameter :: op_multiply = 3               !! a b
    integer, parameter :: op_divide = 4                 !! a/b
    integer, parameter :: op_negate = 5                 !! -a
    integer, parameter :: op_multiply_add = 6           !! a b + c
    integer, parameter :: op_multiply_subtract = 7      !! a b - c
    integer, parameter :: op_subtract_product = 8       !! c - a b
    integer, parameter :: op_product = 9                !! (a b) c
    integer, parameter :: op_power = 10                 !! a^b
    integer, parameter :: op_whole_power = 11           !! a^n, where b is n
    integer, parameter :: op_sin_cos = 12               !! sin(a), and cos(a) in register b
    integer, parameter :: op_function = 20              !! plus the number of the function, of a

    type :: instruction_t
        !! One operation.
        integer :: op = op_number
        integer :: a = 0, b = 0, c = 0  !! registers that it reads
        integer :: target = 0           !! register that it writes
    end type instruction_t

    type :: code_t
        !! Registers hold the symbols, then the numbers, then what is computed.
        integer :: inputs = 0                           !! symbols
        integer :: registers = 0                        !! all of them
        real(dp), allocatable :: numbers(:)             !! registers behind the symbols'
        type(instruction_t), allocatable :: steps(:)    !! in order
        integer, allocatable :: outputs(:)              !! register of each result
    end type code_t
end module lagrangia_formula_code
