! What the module of Fortran has, each used once; test_fortran.py compares the numbers with Python.
module reports
    use, intrinsic :: iso_c_binding, only: c_int64_t
    implicit none
contains
    logical function refuse(done, total)
        integer(c_int64_t), intent(in) :: done, total
        refuse = done > total   ! never: stop at once
    end function
end module

program features
    use, intrinsic :: iso_c_binding, only: c_int64_t, c_ptrdiff_t
    use, intrinsic :: iso_fortran_env, only: real64
    use curvewise
    use reports, only: refuse
    implicit none
    real(real64), target :: P(129, 2), Q(65, 2), many(9, 2, 100)
    type(curve_view) :: views(100)
    integer :: i

    P = loop(129, 0.5_real64)
    Q = loop(65, 0.375_real64)
    do i = 1, 100
        many(:, :, i) = loop(9, 0.0625_real64 * i)
        views(i) = curve_view(many(:, :, i))
    end do
    call of_pairs()
    call of_handles()
    call of_controls()
    call of_materials()

contains

    subroutine of_pairs()
        type(comparison) :: found
        type(pcm_place) :: place
        real(real64), allocatable :: points(:, :), quads(:, :, :), areas(:)
        integer(c_int64_t), allocatable :: path(:, :)
        real(real64) :: distance
        found = compare(P, Q)
        call show('area', found%area)
        call show('curve_length', found%curve_length)
        found = compare(P, Q, preset_raw)
        call show('raw_dtw', found%dtw)
        call dtw_path(P, Q, distance, path, dtw_options(step_pattern=symmetric2))
        call show('path_distance', distance)
        call show('path_length', real(size(path, 2), real64))
        call show('path_sum', real(sum(path), real64))
        call frechet_path(P, Q, distance, path)
        call show('frechet_distance', distance)
        call show('frechet_sum', real(sum(path), real64))
        call pcm_match(P, Q, place, points, pcm_options(offsets=17))
        call show('pcm', place%value)
        call show('coverage', place%coverage)
        call show('maps_p', merge(1.0_real64, 0.0_real64, place%maps_p))
        call show('points', sum(points(:, 2)))
        call area_quads(P, Q, quads, areas)
        call show('quads', quads(2, 3, 20))
        call show('areas', areas(20))
        call show('split', area(P, Q, area_options(crossing=split, squared=.true.)))
        call show('polygon', area(P, Q, area_options(crossing=polygon, closed=.true.)))
        call show('continuous', frechet_continuous(P, Q))
        call show('closed_dtw', dtw(P, Q, dtw_options(closed=.true.)))
        call show('closed_frechet', frechet(P, Q, frechet_options(closed=.true.)))
        call show('closed_continuous', &
            frechet_continuous(P, Q, frechet_continuous_options(closed=.true.)))
        call show('cutoff', merge(1.0_real64, 0.0_real64, &
            frechet(P, Q, frechet_options(cutoff=1e-3_real64)) > huge(1.0_real64)))
    end subroutine

    subroutine of_handles()
        type(prepared_curve) :: prepared
        type(curve_index) :: index, reopened
        real(real64), allocatable :: values(:), distances(:, :), near(:)
        integer(c_int64_t), allocatable :: indices(:, :), within(:)
        integer(c_ptrdiff_t), allocatable :: starts(:)
        integer :: stat
        character(80) :: message
        call prepared%prepare(P, dtw_options())
        call prepared%prepare(Q, frechet_options())     ! frees the first
        call show('prepared', prepared%value(many(:, :, 1)))
        call prepared%values(views, values, workers=2, cutoff=0.5_real64)
        call show('below_cutoff', real(count(values <= 0.5_real64), real64))
        call index%create(views(:50), frechet_options())
        call index%add(views(51:))
        call index%remove([6_c_int64_t])
        call show('size', real(index%size(), real64))
        call index%kneighbors([curve_view(Q)], 3, distances, indices)
        call show('nearest', real(indices(1, 1), real64))
        call show('third', distances(3, 1))
        call index%radius_neighbors([curve_view(Q), curve_view(P)], 100.0_real64, starts, near, within)
        call show('within', real(starts(3) - starts(2), real64))
        call show('within_sum', sum(near))
        call index%save('features.index  ')
        call reopened%open('features.index', frechet_options(), stat, message)
        if (stat /= 0) error stop 'not opened'
        call reopened%indices(within)
        call show('indices', real(sum(within), real64))
        call reopened%kneighbors([curve_view(Q)], 3, distances, indices)
        call show('third_of_file', distances(3, 1))
        call reopened%open('none.index', frechet_options(), stat, message)
        print '(a)', 'no file: ' // trim(message)
        call index%remove([6_c_int64_t], stat, message)
        print '(a)', 'removed twice: ' // trim(message)
        call index%kneighbors([curve_view(Q)], 0, distances, indices, stat=stat, errmsg=message)
        print '(a)', 'no neighbours: ' // trim(message)
    end subroutine

    subroutine of_controls()
        type(call_control) :: control
        real(real64), allocatable :: values(:)
        integer :: stat
        character(80) :: message
        call control%create()
        call pdist(views, dtw_options(), values, workers=2, control=control)
        call show('pdist', sum(values))
        call show('done', real(control%done() - control%total(), real64))
        call control%stop()
        call show('stopped', dtw(P, Q, stat=stat, errmsg=message, control=control))
        print '(a)', 'stopped: ' // trim(message)
        if (stat /= stopped .or. .not. control%stopped()) error stop 'not stopped'
        call control%create(refuse, interval=0)
        call pdist(views, dtw_options(), values, stat=stat, control=control)
        if (stat /= stopped) error stop 'not stopped by the report'
    end subroutine

    subroutine of_materials()
        real(real64), parameter :: steel(6) = [200e3_real64, 250.0_real64, 0.0_real64, 1.0_real64, &
            60e3_real64, 300.0_real64]
        character(*), parameter :: one = 'chaboche-voce backstresses=1'
        real(real64), allocatable :: strain(:), stress(:), slopes(:, :)
        call material_response(one, steel, [300.0_real64, -300.0_real64], strain)
        call show('strain', strain(2))
        call material_response(one, steel, [300.0_real64, -0.01_real64], stress, &
            [.true., .false.], slopes)
        call show('stress', stress(2))
        call show('by_yield', slopes(2, 2))
        call material_stress(one, steel, [0.01_real64], stress)
        call show('driven', stress(1))
    end subroutine

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

    subroutine show(name, value)
        character(*), intent(in) :: name
        real(real64), intent(in) :: value
        print '(a, es26.16e3)', name // ' ', value
    end subroutine
end program
