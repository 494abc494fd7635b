! The five measures of two loops from Fortran, a batch, a material, and what an error looks like.
program fortran_program
    use, intrinsic :: iso_fortran_env, only: real64
    use curvewise, only: area, cdist, curve_length, curve_length_options, curve_view, dtw, &
        dtw_options, frechet, invalid_argument, &
        material_stress, normalize, pcm, pdist, scale_range, symmetric2
    implicit none
    real(real64), target :: P(129, 2), Q(65, 2), history(3, 65)
    real(real64), allocatable :: scaled(:, :), pairs(:), table(:, :), stress(:), slopes(:, :)
    ! E, yield, Q, b, C1, gamma1, C2, gamma2
    real(real64), parameter :: steel(8) = [200e3_real64, 300.0_real64, -50.0_real64, 8.0_real64, &
        80e3_real64, 400.0_real64, 5e3_real64, 20.0_real64]
    type(dtw_options) :: options = dtw_options(step_pattern=symmetric2, window=80)
    type(curve_view) :: curves(3)
    real(real64) :: value
    integer :: stat
    character(80) :: message

    P = loop(129, 0.5_real64)
    Q = loop(65, 0.375_real64)
    ! As a material routine keeps it: strain, temperature and stress of each increment.
    history = 1e6_real64
    history(1:3:2, :) = transpose(Q)

    call show('area', area(P, Q))
    call show('pcm', pcm(P, Q))
    call show('frechet', frechet(P, Q))
    call show('dtw', dtw(P, Q, options))
    call show('curve_length', curve_length(P, Q, curve_length_options(scale=scale_range)))
    call normalize(P, Q, scaled)
    call show('scaled', dtw(P, scaled))
    ! Sections are read where they are: every other point, and the points backwards.
    call show('section', dtw(P(1::2, :), Q(65:1:-1, :)))
    call show('stress', dtw(P(:, 2:2), Q(:, 2:2)))
    call show('history', dtw(transpose(history(1:3:2, :)), P))

    curves = [curve_view(P), curve_view(Q), curve_view(P(:60, :))]
    call pdist(curves, options, pairs)
    call show('P_and_Q', pairs(1))
    call show('P_and_beginning', pairs(2))
    call show('Q_and_beginning', pairs(3))
    call cdist(curves(:1), curves(2:), dtw_options(), table)
    call show('table', table(1, 2))

    call material_stress('chaboche-voce', steel, [0.001_real64, 0.02_real64, -0.02_real64], &
        stress, slopes)
    call show('driven', stress(3))
    call show('driven_by_yield', slopes(2, 3))

    value = area(P, history(:2, :), stat=stat, errmsg=message)
    if (stat /= invalid_argument) error stop 'a curve of 65 coordinates was accepted'
    print '(a)', 'refused: ' // trim(message)

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

    subroutine show(name, value)
        character(*), intent(in) :: name
        real(real64), intent(in) :: value
        print '(a, es26.16e3)', name // ' ', value
    end subroutine
end program
