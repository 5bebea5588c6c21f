module lagrangia_explanation
    !! Why a statement is wrong: the change that makes it right, and what of it others decide by.
    implicit none (type, external)
    private
    public :: explanation_t, explanation_text

    type :: explanation_t
        !! Of one wrong statement; the text is empty where none is found.
        character(:), allocatable :: text   !! the change, for the student
        character(:), allocatable :: lacks  !! what is missing on the left side, if that is known
        integer :: width = huge(0)
        !! of the change, from that of a sign to that of several terms
        logical :: is_vague = .false.
        !! a term is missing whose factor is not known, or a factor that stands for a formula
        logical :: is_surplus = .false.     !! a term does not belong there
    contains
        procedure :: is_empty
    end type explanation_t

contains

    pure function is_empty(self) result(yes)
        !! No change is known that makes it right.
        class(explanation_t), intent(in) :: self
        logical :: yes

        yes = .not. allocated(self%text)
        if (.not. yes) yes = self%text == ""
    end function is_empty

    pure function explanation_text(explanation) result(text)
        !! The change, or that no single one does it.
        type(explanation_t), intent(in) :: explanation  !! of a wrong statement
        character(:), allocatable :: text

        if (explanation%is_empty()) then
            text = "no single change of a sign, letter, dot, factor, function, exponent or "// &
                   "term makes it right"
        else
            text = explanation%text
        end if
    end function explanation_text
end module lagrangia_explanation
