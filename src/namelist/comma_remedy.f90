module lagrangia_comma_remedy
    !! How to write a text with commas behind `--set`.
    use lagrangia_namelist_tree, only: in_override, namelist_t
    use lagrangia_text, only: escaped
    implicit none (type, external)
    private
    public :: comma_remedy

contains

    pure function comma_remedy(tree, position) result(remedy)
        !! Of a text that `--set` gives without quotes, and that ends at its first comma: how to
        !! write it; else empty.
        type(namelist_t), intent(in) :: tree   !! of a file, with what is set
        integer, intent(in) :: position        !! of a value, in the tree's text
        character(:), allocatable :: remedy
        character(:), allocatable :: set
        integer :: equals, last, part

        remedy = ""
        if (.not. in_override(tree, position)) return
        part = count(tree%starts <= position)
        last = len(tree%text)
        if (part < size(tree%starts)) last = tree%starts(part + 1) - 1
        set = tree%text(tree%starts(part):last)
        equals = index(set, "=")
        if (index(set, ",") == 0 .or. scan(set, "'"//'"') > 0 .or. equals == 0) return
        remedy = '; a text with commas has quotes around all of it: --set "'// &
                 escaped(set(:equals)//"'"//trim(adjustl(set(equals + 1:)))//"'", 80)//'"'
    end function comma_remedy
end module lagrangia_comma_remedy
