module lagrangia_lecture_text
    !! What the program says of a system, as HTML: what the lecture has, the derivation line by
    !! line, the slips in the notes.
    use lagrangia_derivation, only: derivation_t
    use lagrangia_derivation_numbers, only: comparison_t, compare_lines
    use lagrangia_derivation_steps, only: derive, slip_in_formula_t
    use lagrangia_description, only: constraint_text, description_t
    use lagrangia_errata_ledger, only: kind_none, slip_t, slips_of_the_notes
    use lagrangia_errors, only: error_t
    use lagrangia_html, only: html_text
    use lagrangia_random_draws, only: random_t
    use lagrangia_system, only: system_t
    use lagrangia_system_lines, only: line_of_system
    use lagrangia_text, only: lower, to_text
    implicit none (type, external)
    private
    public :: derivation_html, errata_html, lecture_html

    character, parameter :: newline = new_line("a")

contains

    function lecture_html(system) result(html)
        !! Source, Lagrangian, equations of motion, constraints, frequencies, remarks.
        class(system_t), intent(in) :: system  !! with its parameters
        character(:), allocatable :: html
        type(description_t) :: d
        integer :: i

        call system%describe(d)
        if (d%source == "your own") then
            html = "<h3>The system</h3>"//newline
        else
            html = "<h3>What the lecture has</h3>"//newline
            html = html//paragraph(d%source)
        end if
        if (line_of_system(trim(d%name)) /= "") then
            html = html//paragraph(line_of_system(trim(d%name)))
        end if
        if (allocated(d%lagrangian)) html = html//code("L = "//d%lagrangian)
        if (allocated(d%equations)) then
            do i = 1, size(d%equations)
                html = html//code(d%equations(i))
            end do
        end if
        html = html//paragraph("Constraints: "//constraint_text(d))
        if (allocated(d%frequencies)) then
            do i = 1, size(d%frequencies)
                html = html//code(trim(d%frequencies(i)%equation)//"   at "// &
                                  d%frequencies(i)%equilibrium)
            end do
        end if
        if (.not. allocated(d%notes)) return
        do i = 1, size(d%notes)
            html = html//paragraph(d%notes(i))
        end do
    end function lecture_html

    function derivation_html(system) result(html)
        !! What `lagrangia derive` prints: steps as headings, lines as they are, and how many of
        !! them the program agrees with at a random state.
        class(system_t), intent(in) :: system  !! with its parameters
        character(:), allocatable :: html
        type(derivation_t) :: derivation
        type(comparison_t), allocatable :: comparisons(:)
        type(slip_in_formula_t) :: none
        type(random_t) :: random
        type(error_t), allocatable :: error
        integer :: i

        html = "<h3>Derivation</h3>"//newline
        call derive(system, none, derivation, error)
        if (.not. allocated(error)) call compare_lines(derivation, system, random, comparisons, &
                                                       error)
        if (allocated(error)) then
            html = html//paragraph("none: "//error%message)
            return
        end if
        do i = 1, derivation%count
            associate (line => derivation%lines(i))
                if (line%heading /= "") html = html//"<h4>"//html_text(line%heading)//"</h4>"// &
                                               newline
                if (line%hidden .and. comparisons(i)%agrees()) cycle
                html = html//code(derivation%line_text(i))
                if (.not. comparisons(i)%agrees()) html = html//'<p class="wrong">'// &
                    "this line is not what the program computes</p>"//newline
            end associate
        end do
        html = html//paragraph(to_text(count(comparisons%known .and. comparisons%agrees()))// &
                               " of "//to_text(count(comparisons%known))//" lines that are "// &
                               "numbers agree with the program at a state drawn at random.")
    end function derivation_html

    function errata_html(system) result(html)
        !! The slips in the notes that concern the system, word for word; "" if there are none.
        class(system_t), intent(in) :: system  !! with its parameters
        character(:), allocatable :: html
        type(slip_t), allocatable :: slips(:)
        type(description_t) :: d
        integer :: i, k

        call system%describe(d)
        allocate (slips, source=slips_of_the_notes())
        html = ""
        do i = 1, size(slips)
            associate (slip => slips(i))
                if (.not. concerns(slip, trim(d%name)) .or. slip%kind == kind_none) cycle
                html = html//"<h4>"//html_text(trim(slip%id)//", "//trim(slip%kind)//": "// &
                                               slip%subject)//"</h4>"//newline
                do k = 1, size(slip%quotes)
                    if (slip%quotes(k)%scan == "") exit
                    html = html//"<blockquote><code>"//html_text(slip%quotes(k)%text)// &
                           "</code> ("//trim(slip%quotes(k)%scan)//", "// &
                           to_text(slip%quotes(k)%line)//")</blockquote>"//newline
                end do
                html = html//paragraph("reads: "//slip%reads)// &
                       paragraph("as derived: "//slip%derived)
                if (slip%effect /= "") html = html//paragraph("effect: "//slip%effect)
            end associate
        end do
        if (html /= "") html = "<h3>Slips in the notes</h3>"//newline// &
            paragraph("Lines of the scans' text: I is Phys 601 of 1 September 2011, II is "// &
                      "Hamilton's Principle.")//html
    end function errata_html

    pure function concerns(slip, name) result(yes)
        !! It has formulas of the system, or its subject begins with the system's name.
        type(slip_t), intent(in) :: slip
        character(*), intent(in) :: name
        logical :: yes

        yes = slip%system == name .or. index(plain(slip%subject), plain(name)) == 1
    end function concerns

    pure function plain(text) result(words)
        !! In lower case, with blanks for hyphens and underscores.
        character(*), intent(in) :: text
        character(len(text)) :: words
        integer :: i

        words = lower(text)
        do i = 1, len(words)
            if (scan(words(i:i), "-_") > 0) words(i:i) = " "
        end do
    end function plain

    function paragraph(text) result(html)
        !! Words.
        character(*), intent(in) :: text
        character(:), allocatable :: html

        html = "<p>"//html_text(text)//"</p>"//newline
    end function paragraph

    function code(text) result(html)
        !! A formula.
        character(*), intent(in) :: text
        character(:), allocatable :: html

        html = '<p class="line">'//html_text(text)//"</p>"//newline
    end function code
end module lagrangia_lecture_text
