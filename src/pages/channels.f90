module lagrangia_channels
    !! Many numbers in little text: each series between its bounds in 2^18 steps, three characters
    !! a number. A picture shows no more, and a page with a film stays small.
    use lagrangia_json, only: json_item, json_number, json_object, json_pair
    use lagrangia_kinds, only: dp
    implicit none (type, external)
    private
    public :: channels_t
    public :: bytes_beside, bytes_of_number, unpacked

    character(64), parameter :: digits = &
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"
    integer, parameter :: steps = 64**3 - 1
    integer, parameter :: bytes_of_number = 3
    integer, parameter :: bytes_beside = 160  !! of a series, besides its numbers, and of its use

    type :: channels_t
        !! Series of one length, as JSON.
        integer :: count = 0
        character(:), allocatable :: json  !! `{"lo": ..., "hi": ..., "d": "..."}`, with commas
    contains
        procedure :: add
        procedure :: number
    end type channels_t

contains

    subroutine add(self, values, which)
        !! One more series.
        class(channels_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)  !! finite, one at least
        integer, intent(out) :: which      !! its number, from 0

        if (.not. allocated(self%json)) self%json = ""
        if (self%count > 0) self%json = self%json//","//new_line("a")
        self%json = self%json//json_object(json_pair("lo", minval(values))// &
                                           json_pair("hi", maxval(values))// &
                                           json_item("d", '"'//packed(values)//'"'))
        which = self%count
        self%count = self%count + 1
    end subroutine add

    subroutine number(self, values, json)
        !! A series as one number where it does not change, else added: `{"c": 3}`.
        class(channels_t), intent(inout) :: self
        real(dp), intent(in) :: values(:)               !! finite
        character(:), allocatable, intent(out) :: json  !! what stands for it
        integer :: which

        if (maxval(values) - minval(values) <= 4.0_dp*epsilon(1.0_dp)*maxval(abs(values))) then
            json = json_number(values(1))
            return
        end if
        call self%add(values, which)
        json = json_object(json_pair("c", which))
    end subroutine number

    pure function packed(values) result(text)
        !! Three digits of base 64 a number, the first counts most.
        real(dp), intent(in) :: values(:)
        character(3*size(values)) :: text
        real(dp) :: low, width
        integer :: i, k

        low = minval(values)
        width = maxval(values) - low
        do i = 1, size(values)
            k = 0
            if (width > 0.0_dp .and. width <= huge(width)) k = nint((values(i) - low)/width*steps)
            text(3*i - 2:3*i - 2) = digits(k/4096 + 1:k/4096 + 1)
            text(3*i - 1:3*i - 1) = digits(mod(k/64, 64) + 1:mod(k/64, 64) + 1)
            text(3*i:3*i) = digits(mod(k, 64) + 1:mod(k, 64) + 1)
        end do
    end function packed

    pure function unpacked(text, low, high) result(values)
        !! What a page reads out of it.
        character(*), intent(in) :: text  !! three characters a number
        real(dp), intent(in) :: low, high  !! the bounds
        real(dp) :: values(len(text)/3)
        integer :: i, k

        do i = 1, size(values)
            k = 4096*(index(digits, text(3*i - 2:3*i - 2)) - 1) + &
                64*(index(digits, text(3*i - 1:3*i - 1)) - 1) + index(digits, text(3*i:3*i)) - 1
            values(i) = low + (high - low)*k/steps
        end do
    end function unpacked
end module lagrangia_channels
