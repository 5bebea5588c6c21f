module lagrangia_images
    !! Coarray images: how many there are, blocks of work dealt to whoever is free, and what all
    !! agree on. In a plain build there is one image and nothing is sent.
    !!
    !! The blocks are counted by a number on image 1, which an image locks, reads and raises without
    !! anybody else having to take part.
    !! (`atomic_fetch_add` would do it in one, but the old number does not come back from
    !! OpenCoarrays 2.9 and 2.10 as Debian builds them.)
    use, intrinsic :: iso_fortran_env, only: lock_type
    use lagrangia_kinds, only: i8
    implicit none (type, external)
    private
    public :: all_agree, begin_dealing, deal, image_count, image_number, wait_for_all

contains

    function image_number() result(number)
        !! Which image this is, from 1.
        integer :: number

        number = this_image()
    end function image_number

    function image_count() result(count)
        !! How many there are.
        integer :: count

        count = num_images()
    end function image_count

    subroutine begin_dealing()
        !! All images: from now on the first block is the next.
        integer(i8) :: number

        call dealt(.true., number)
    end subroutine begin_dealing

    subroutine deal(number)
        !! Take the next block.
        integer(i8), intent(out) :: number  !! from 1

        call dealt(.false., number)
    end subroutine deal

    subroutine dealt(anew, number)
        !! The counter is local, so that no module file tells of a coarray: who uses this module
        !! need not be compiled for them.
        logical, intent(in) :: anew  !! the first is the next, instead of taking one
        integer(i8), intent(out) :: number
        integer(i8), save :: next[*]
        type(lock_type), save :: turn[*]

        number = 1
        if (anew) then
            sync all
            next = 1
            sync all
        else
            lock (turn[1])
            number = next[1]
            next[1] = number + 1
            unlock (turn[1])
        end if
    end subroutine dealt

    subroutine wait_for_all()
        !! Until every image has come here.
        sync all
    end subroutine wait_for_all

    function all_agree(good) result(all_good)
        !! Whether all images say so; each waits for the others.
        logical, intent(in) :: good  !! this image does
        logical :: all_good
        integer :: bad

        bad = merge(0, 1, good)
        call co_max(bad)
        all_good = bad == 0
    end function all_agree
end module lagrangia_images
