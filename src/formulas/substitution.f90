module lagrangia_substitution
    !! Formulas in the places of symbols.
    use lagrangia_expression, only: expression_t, kind_symbol
    implicit none (type, external)
    private
    public :: substituted

contains

    pure function substituted(expression, places, meanings) result(e)
        !! The formula with each of some symbols written out.
        type(expression_t), intent(in) :: expression   !! not empty
        integer, intent(in) :: places(:)               !! of the symbols; 0 stands for none
        type(expression_t), intent(in) :: meanings(:)  !! what each of them stands for
        type(expression_t) :: e
        integer :: becomes(0:expression%count), root(size(places)), i, k

        becomes = 0
        root = 0
        do i = 1, expression%count
            associate (node => expression%nodes(i))
                k = 0
                if (node%kind == kind_symbol) k = findloc(places, node%which, 1)
                if (k == 0) then
                    call e%add_copy(expression, i, becomes)
                else
                    if (root(k) == 0) call e%append(meanings(k), root(k))
                    becomes(i) = root(k)
                end if
            end associate
        end do
    end function substituted
end module lagrangia_substitution
