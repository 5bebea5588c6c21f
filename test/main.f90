program main
    !! Run every suite; stop with status 2 if a test fails.
    use funit, only: finalize, initialize, run
    use suites, only: load_tests
    use surroundings, only: prepare
    use test_scratch, only: clean_up
    implicit none (type, external)
    logical :: ok

    call initialize(prepare)
    ok = run(load_tests)
    call finalize(clean_up, ok)
end program main
