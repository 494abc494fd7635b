! A calibration loop around a material point: a test was driven by stress, and its strains were
! measured. Gauss-Newton steps with the exact derivatives find the parameters of the material.
program stress_control
    use, intrinsic :: iso_fortran_env, only: real64
    use curvewise, only: dtw, material_response
    implicit none
    integer, parameter :: n = 257, free(3) = [2, 5, 6]   ! yield, C1, gamma1
    character(6), parameter :: names(3) = ['yield ', 'C1    ', 'gamma1']
    character(*), parameter :: steel = 'chaboche-voce backstresses=1'
    real(real64) :: stress(n), parameters(6), trial(6), step(3), matrix(3, 3), right(3)
    real(real64), allocatable :: measured(:), strain(:), slopes(:, :)
    real(real64) :: error, least
    integer :: i, j, k, stat
    character(200) :: message

    ! Two cycles of increasing stress, and the strains of the true material: E, yield, Q, b, C1,
    ! gamma1.
    stress = [(wave(i), i = 1, n)]
    parameters = [200e3_real64, 250.0_real64, 0.0_real64, 1.0_real64, 60e3_real64, 300.0_real64]
    call material_response(steel, parameters, stress, measured)

    parameters(free) = [300.0_real64, 40e3_real64, 200.0_real64]   ! the first guess
    call material_response(steel, parameters, stress, strain, slopes=slopes)
    least = sum((strain - measured)**2)
    do k = 1, 50
        do i = 1, 3
            right(i) = -dot_product(slopes(free(i), :), strain - measured)
            matrix(i, :) = [(dot_product(slopes(free(i), :), slopes(free(j), :)), j = 1, 3)]
        end do
        step = solved(matrix, right)
        do  ! half of the step, until the error falls
            trial = parameters
            trial(free) = parameters(free) + step
            call material_response(steel, trial, stress, strain, slopes=slopes, stat=stat, &
                errmsg=message)
            error = huge(error)
            if (stat == 0) error = sum((strain - measured)**2)
            if (error < least .or. maxval(abs(step / parameters(free))) < 1e-12_real64) exit
            step = step / 2
        end do
        if (error >= least) exit
        least = error
        parameters = trial
    end do
    do i = 1, 3
        print '(a, es26.16e3)', names(i), parameters(free(i))
    end do
    call material_response(steel, parameters, stress, strain)
    print '(a, es26.16e3)', 'dtw ', dtw(reshape([strain, stress], [n, 2]), &
        reshape([measured, stress], [n, 2]))

contains

    ! A triangle wave, larger in the second cycle.
    real(real64) function wave(i)
        integer, intent(in) :: i
        real(real64) :: t
        t = modulo(8.0_real64 * (i - 1) / (n - 1), 4.0_real64)
        wave = merge(360, 400, 2 * i <= n) * merge(t, merge(2 - t, t - 4, t < 3), t < 1)
    end function

    ! The solution of three equations, by Cramer's rule.
    function solved(a, b) result(x)
        real(real64), intent(in) :: a(3, 3), b(3)
        real(real64) :: x(3), replaced(3, 3)
        integer :: c
        do c = 1, 3
            replaced = a
            replaced(:, c) = b
            x(c) = determinant(replaced) / determinant(a)
        end do
    end function

    real(real64) function determinant(a)
        real(real64), intent(in) :: a(3, 3)
        determinant = a(1, 1) * (a(2, 2) * a(3, 3) - a(2, 3) * a(3, 2)) &
            - a(1, 2) * (a(2, 1) * a(3, 3) - a(2, 3) * a(3, 1)) &
            + a(1, 3) * (a(2, 1) * a(3, 2) - a(2, 2) * a(3, 1))
    end function
end program
