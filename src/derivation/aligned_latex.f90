module lagrangia_aligned_latex
    !! Formulas for LaTeX's `align`: what is longer than a line is broken in front of a sign.
    use lagrangia_expression, only: expression_t, kind_difference, kind_sum
    use lagrangia_formula_latex, only: latex
    use lagrangia_formula_text, only: rank_of, rank_product
    use lagrangia_symbols, only: symbols_t
    implicit none (type, external)
    private
    public :: aligned_latex

    integer, parameter :: widest = 130  !! characters of LaTeX in a line of the page, or so

contains

    pure recursive function aligned_latex(expression, symbols) result(text)
        !! The formula, in lines that a line feed ends.
        type(expression_t), intent(in) :: expression  !! of the symbols
        type(symbols_t), intent(in) :: symbols        !! their names
        character(:), allocatable :: text
        character(:), allocatable :: right, sign
        integer :: last

        text = latex(expression, symbols)
        if (len(text) <= widest) return
        associate (root => expression%nodes(expression%count))
            if (root%kind /= kind_sum .and. root%kind /= kind_difference) return
            text = aligned_latex(expression%pruned(root%left), symbols)
            right = latex(expression%pruned(root%right), symbols)
            if (rank_of(expression%nodes(root%right)) < rank_product) then
                right = "\left("//right//"\right)"
            end if
            sign = merge(" + ", " - ", root%kind == kind_sum)
        end associate
        last = index(text, new_line("a"), back=.true.)
        if (len(text) - last + len(right) > widest) then
            sign = " \\"//new_line("a")//"    & \quad{}"//sign
        end if
        text = text//sign//right
    end function aligned_latex
end module lagrangia_aligned_latex
