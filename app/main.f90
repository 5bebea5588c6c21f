program main
    !! The command, as it is shipped.
    use lagrangia, only: lagrangia_main
    implicit none (type, external)

    call lagrangia_main()
end program main
