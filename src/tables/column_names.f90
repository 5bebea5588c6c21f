module lagrangia_column_names
    !! Names of columns as readers of csv and npy need them: each stands for one column.
    use lagrangia_text, only: to_text
    implicit none (type, external)
    private
    public :: told_apart

contains

    pure function told_apart(names) result(different)
        !! The same names, but `event_2` for a second `event`.
        character(*), intent(in) :: names(:)  !! of columns, from left to right
        character(len(names) + 8) :: different(size(names))
        integer :: i, number

        do i = 1, size(names)
            different(i) = names(i)
            number = 1
            do while (any(different(:i - 1) == different(i)) .or. &
                      (number > 1 .and. any(names(i + 1:) == different(i))))
                number = number + 1
                different(i) = trim(names(i))//"_"//to_text(number)
            end do
        end do
    end function told_apart
end module lagrangia_column_names
