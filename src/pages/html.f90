module lagrangia_html
    !! Texts inside a page, and templates with gaps for them.
    use lagrangia_characters, only: decode, is_control, printable
    use lagrangia_errors, only: error_t
    use lagrangia_output_file, only: output_file_t
    use lagrangia_shipped_files, only: shipped_text
    use lagrangia_text, only: word_t
    implicit none (type, external)
    private
    public :: fill_template, html_text, replaced, script_json, write_template

contains

    pure function html_text(text) result(html)
        !! `text` as it reads, between tags or in an attribute; trailing blanks do not count.
        !! Control characters and bytes that are not UTF-8 become `\xNN`, as on the screen.
        character(*), intent(in) :: text  !! any bytes
        character(:), allocatable :: html
        integer :: i, code, length

        html = ""
        i = 1
        do while (i <= len_trim(text))
            call decode(text, i, code, length)
            if (code < 0 .or. is_control(code)) then
                if (text(i:i) == new_line("a")) then
                    html = html//text(i:i)
                else
                    html = html//printable(text(i:i + length - 1))
                end if
            else
                select case (text(i:i))
                case ("&"); html = html//"&amp;"
                case ("<"); html = html//"&lt;"
                case (">"); html = html//"&gt;"
                case ('"'); html = html//"&quot;"
                case ("'"); html = html//"&#39;"
                case default; html = html//text(i:i + length - 1)
                end select
            end if
            i = i + length
        end do
    end function html_text

    pure function script_json(json) result(text)
        !! JSON that may stand in a `script` element: no `<` in it begins or ends anything.
        character(*), intent(in) :: json  !! with `<` in strings only
        character(:), allocatable :: text

        text = replaced(json, "<", "\u003c")
    end function script_json

    pure function replaced(text, old, new) result(other)
        !! `text` with `new` in each place of `old`.
        character(*), intent(in) :: text      !! any bytes
        character(*), intent(in) :: old, new  !! `old` not empty; every blank counts
        character(:), allocatable :: other
        integer :: at, from

        other = ""
        from = 1
        do
            at = index(text(from:), old)
            if (at == 0) exit
            other = other//text(from:from + at - 2)//new
            from = from + at - 1 + len(old)
        end do
        other = other//text(from:)
    end function replaced

    pure subroutine fill_template(template, names, texts, page)
        !! The template with each `@NAME@` replaced; what is filled in is not looked at.
        character(*), intent(in) :: template, names(:)  !! with gaps; their names, upper case
        type(word_t), intent(in) :: texts(:)            !! for them
        character(:), allocatable, intent(out) :: page  !! complete
        character(:), allocatable :: gap
        integer :: i, from, at, first, which

        page = ""
        from = 1
        do
            first = 0
            which = 0
            do i = 1, size(names)
                at = index(template(from:), "@"//trim(names(i))//"@")
                if (at == 0 .or. (first > 0 .and. at > first)) cycle
                first = at
                which = i
            end do
            if (which == 0) exit
            gap = "@"//trim(names(which))//"@"
            page = page//template(from:from + first - 2)//texts(which)%text
            from = from + first - 1 + len(gap)
        end do
        page = page//template(from:)
    end subroutine fill_template

    subroutine write_template(template, names, texts, path, error)
        !! A template that the program carries, filled in, as a file: whole or not at all.
        character(*), intent(in) :: template            !! `data/templates/report.html`
        character(*), intent(in) :: names(:)            !! of its gaps, upper case
        type(word_t), intent(in) :: texts(:)            !! for them
        character(*), intent(in) :: path                !! of the file; folders are made
        type(error_t), allocatable, intent(out) :: error  !! status 5: it cannot be written
        type(output_file_t) :: file
        character(:), allocatable :: page, text

        call shipped_text(template, text)
        call fill_template(text, names, texts, page)
        call file%open(path, error)
        if (allocated(error)) return
        call file%write(page)
        call file%commit(error)
    end subroutine write_template
end module lagrangia_html
