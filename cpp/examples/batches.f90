! Many curves from Fortran: all distances between tests and simulations on two threads with a report,
! and an index of the simulations.
module progress
    use, intrinsic :: iso_c_binding, only: c_int64_t
    implicit none
    integer(c_int64_t) :: last_done = 0, last_total = 0
contains
    logical function remember(done, total)
        integer(c_int64_t), intent(in) :: done, total
        last_done = done
        last_total = total
        remember = .true.   ! continue
    end function
end module

program batches
    use, intrinsic :: iso_c_binding, only: c_int64_t, c_ptrdiff_t
    use, intrinsic :: iso_fortran_env, only: real64
    use curvewise, only: call_control, cdist, curve_index, curve_view, dtw_options, symmetric2
    use progress, only: last_done, last_total, remember
    implicit none
    integer, parameter :: simulations = 12, tests = 3
    real(real64), target :: simulated(33, 2, simulations), tested(65, 2, tests)
    type(curve_view) :: simulated_views(simulations), tested_views(tests)
    type(dtw_options) :: options = dtw_options(step_pattern=symmetric2)
    type(call_control) :: control
    type(curve_index) :: index
    real(real64), allocatable :: table(:, :), distances(:, :), near(:)
    integer(c_int64_t), allocatable :: indices(:, :), within(:)
    integer(c_ptrdiff_t), allocatable :: starts(:)
    integer :: i

    do i = 1, simulations
        simulated(:, :, i) = loop(33, 0.125_real64 * i)
        simulated_views(i) = curve_view(simulated(:, :, i))
    end do
    do i = 1, tests
        tested(:, :, i) = loop(65, 0.25_real64 * i + 0.0625_real64)
        tested_views(i) = curve_view(tested(:, :, i))
    end do

    call control%create(remember)
    call cdist(tested_views, simulated_views, options, table, workers=2, control=control)
    do i = 1, tests
        print '(a, i0, a, i0, es26.16e3)', 'test ', i, ' best ', minloc(table(i, :), 1), &
            minval(table(i, :))
    end do
    if (last_done == last_total .and. last_total > 0) print '(a)', 'reported all of the work'

    call index%create(simulated_views(:6), options)
    call index%add(simulated_views(7:))
    call index%kneighbors(tested_views, 2, distances, indices)
    print '(a, 6(1x, i0))', 'nearest', indices
    call index%radius_neighbors(tested_views(2:2), distances(2, 2), starts, near, within)
    print '(a, 3(1x, i0))', 'within', within(starts(1):starts(2) - 1)
    print '(a, i0)', 'simulations ', index%size()

contains

    ! A closed loop: x a triangle wave, y a parabola on each branch.
    function loop(n, height) result(points)
        integer, intent(in) :: n
        real(real64), intent(in) :: height
        real(real64) :: points(n, 2), t, u, bow
        integer :: i
        do i = 1, n
            t = 4.0_real64 * (i - 1) / (n - 1)
            u = merge(t - 1, 3 - t, t < 2)
            bow = height * (1 - u * u)
            points(i, :) = [u, merge(u + bow, u - bow, t < 2)]
        end do
    end function
end program
