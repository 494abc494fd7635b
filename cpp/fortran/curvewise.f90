! curvewise for Fortran (2018): a thin module over the C interface, curvewise.h. A curve is an array
! P(n, d) of doubles, points by coordinates, or any section of one: strides are passed on, nothing
! is copied. The numbers are those of C++ and Python, to the last bit; what a measure means, costs
! and refuses is written in the C++ header of its name.
!
!   use curvewise, only: dtw, dtw_options, symmetric2
!   value = dtw(experiment, simulation)
!   value = dtw(experiment, history(:, 2:3), dtw_options(step_pattern=symmetric2), stat, errmsg)
!
! As with allocate, an error is reported in stat (0: none) and errmsg where stat is given, and ends
! the program with the message where it is not. All functions may be called from any thread. The
! module is given as source, since a compiled one suits one compiler only: compile this file with
! your own, and link the library.
module curvewise
    use, intrinsic :: iso_c_binding, only: c_char, c_double, c_f_pointer, c_int, c_intptr_t, &
        c_loc, c_null_char, c_null_ptr, c_ptr, c_ptrdiff_t, c_size_t
    implicit none
    private
    public :: area, cdist, chaboche_voce_stress, curve_length, curvewise_version, dtw, frechet, &
        frechet_continuous, normalize, pcm, pdist, yoshida_uemori_stress

    integer(c_int), parameter, public :: euclidean = 0, sqeuclidean = 1, cityblock = 2, &
        chebyshev = 3, minkowski = 4, haversine = 5         ! metric
    ! step_pattern; the others by their places in curvewise.h
    integer(c_int), parameter, public :: symmetric1 = 0, symmetric2 = 1
    integer(c_int), parameter, public :: spacing_distance = 0, spacing_x = 1, &
        spacing_arc_length = 2, spacing_matched = 3, spacing_function = 4        ! spacing
    integer(c_int), parameter, public :: rearrange = 0, split = 1                ! crossing
    integer(c_int), parameter, public :: scale_mean = 0, scale_mean_abs = 1, scale_range = 2
    integer(c_ptrdiff_t), parameter, public :: no_window = -1
    integer(c_int), parameter, public :: measure_area = 0, measure_pcm = 1, measure_frechet = 2, &
        measure_dtw = 3, measure_curve_length = 4, measure_frechet_continuous = 5  ! measure
    integer(c_int), parameter, public :: modulus_constant = 0, modulus_decaying = 1   ! modulus
    integer(c_int), parameter, public :: growth_saturating = 0, growth_power = 1      ! growth
    integer(c_int), parameter, public :: invalid_argument = 1, no_memory = 2, failed = 3  ! stat

    type, bind(C), public :: area_options
        integer(c_int) :: spacing = spacing_distance
        integer(c_int) :: crossing = rearrange
        integer(c_int) :: squared = 0           ! not 0: sum the squared areas
    end type

    type, bind(C), public :: pcm_options
        integer(c_ptrdiff_t) :: offsets = 200   ! at least 1
        integer(c_int) :: continuous = 0        ! not 0: search all offsets
    end type

    type, bind(C), public :: frechet_options
        integer(c_int) :: metric = euclidean
        real(c_double) :: p = 2                 ! the order of minkowski
        integer(c_ptrdiff_t) :: workers = 1     ! threads, -1 for one per core
        integer(c_int) :: prune = 1             ! not 0: leave out what cannot matter
        real(c_double) :: cutoff = huge(1.0_c_double)  ! a value above it becomes infinity
        real(c_double) :: radius = 6371008.8_c_double  ! of the sphere of haversine
    end type

    type, bind(C), public :: dtw_options
        integer(c_int) :: metric = euclidean
        real(c_double) :: p = 2
        integer(c_int) :: step_pattern = symmetric1
        integer(c_int) :: open_begin = 0        ! not 0: P is matched to a part of Q
        integer(c_int) :: open_end = 0
        integer(c_ptrdiff_t) :: window = no_window
        integer(c_ptrdiff_t) :: workers = 1
        integer(c_int) :: prune = 1
        real(c_double) :: cutoff = huge(1.0_c_double)
        real(c_double) :: window_fraction = 0   ! not 0: of the longer curve's points, as window
        integer(c_int) :: normalize = 0         ! not 0: divide by the weight of all paths
        real(c_double) :: penalty = 0           ! of each step that leaves the diagonal
        real(c_double) :: radius = 6371008.8_c_double
        integer(c_ptrdiff_t) :: relax_p_begin = 0  ! how many first points of P may be left out
        integer(c_ptrdiff_t) :: relax_p_end = 0    ! how many last points of P may be left out
        integer(c_ptrdiff_t) :: relax_q_begin = 0  ! the same of Q
        integer(c_ptrdiff_t) :: relax_q_end = 0
    end type

    type, bind(C), public :: curve_length_options
        integer(c_int) :: scale = scale_mean
    end type

    type, bind(C), public :: frechet_continuous_options
        integer(c_ptrdiff_t) :: workers = 1     ! threads, -1 for one per core
    end type

    type, bind(C), public :: batch_options
        integer(c_ptrdiff_t) :: workers = 1     ! threads, -1 for one per core
        real(c_double) :: cutoff = huge(1.0_c_double)  ! a value above it becomes infinity
    end type

    type, bind(C), public :: chaboche_voce
        integer(c_int) :: backstresses = 2      ! 0 to 99
        integer(c_int) :: modulus = modulus_constant
    end type

    type, bind(C), public :: yoshida_uemori
        integer(c_int) :: growth = growth_saturating
        integer(c_int) :: modulus = modulus_constant
        real(c_double) :: rtol = 1e-9_c_double  ! the error of the integration, relative to CB
    end type

    ! A curve among others, for cdist and pdist: curve_view(P), where P has the attribute target.
    type, bind(C), public :: curve_view
        private
        type(c_ptr) :: data = c_null_ptr
        integer(c_ptrdiff_t) :: n, dim, row_stride = 1, col_stride = 1
    end type

    interface curve_view
        module procedure view
    end interface

    type, bind(C) :: error_message
        character(kind=c_char) :: text(256) = c_null_char
    end type

    ! An option argument that is absent is a null pointer: the defaults.
    interface
        integer(c_int) function c_area(P, Q, options, value, error) bind(C, name="curvewise_area")
            import
            type(curve_view), intent(in) :: P, Q
            type(area_options), intent(in), optional :: options
            real(c_double), intent(out) :: value
            type(error_message), intent(out) :: error
        end function

        integer(c_int) function c_pcm(P, Q, options, value, error) bind(C, name="curvewise_pcm")
            import
            type(curve_view), intent(in) :: P, Q
            type(pcm_options), intent(in), optional :: options
            real(c_double), intent(out) :: value
            type(error_message), intent(out) :: error
        end function

        integer(c_int) function c_frechet(P, Q, options, value, error) &
            bind(C, name="curvewise_frechet")
            import
            type(curve_view), intent(in) :: P, Q
            type(frechet_options), intent(in), optional :: options
            real(c_double), intent(out) :: value
            type(error_message), intent(out) :: error
        end function

        integer(c_int) function c_dtw(P, Q, options, value, error) bind(C, name="curvewise_dtw")
            import
            type(curve_view), intent(in) :: P, Q
            type(dtw_options), intent(in), optional :: options
            real(c_double), intent(out) :: value
            type(error_message), intent(out) :: error
        end function

        integer(c_int) function c_curve_length(P, Q, options, value, error) &
            bind(C, name="curvewise_curve_length")
            import
            type(curve_view), intent(in) :: P, Q
            type(curve_length_options), intent(in), optional :: options
            real(c_double), intent(out) :: value
            type(error_message), intent(out) :: error
        end function

        integer(c_int) function c_frechet_continuous(P, Q, options, value, error) &
            bind(C, name="curvewise_frechet_continuous")
            import
            type(curve_view), intent(in) :: P, Q
            type(frechet_continuous_options), intent(in), optional :: options
            real(c_double), intent(out) :: value
            type(error_message), intent(out) :: error
        end function

        integer(c_int) function c_normalize(P, C, out, error) bind(C, name="curvewise_normalize")
            import
            type(curve_view), intent(in) :: P, C
            real(c_double), intent(out) :: out(*)
            type(error_message), intent(out) :: error
        end function

        integer(c_int) function c_cdist(XA, na, XB, nb, measure, options, batch, out, error) &
            bind(C, name="curvewise_cdist")
            import
            type(curve_view), intent(in) :: XA(*), XB(*)
            integer(c_ptrdiff_t), value :: na, nb
            integer(c_int), value :: measure
            type(c_ptr), value :: options
            type(batch_options), intent(in), optional :: batch
            real(c_double), intent(out) :: out(*)
            type(error_message), intent(out) :: error
        end function

        integer(c_int) function c_pdist(X, k, measure, options, batch, out, error) &
            bind(C, name="curvewise_pdist")
            import
            type(curve_view), intent(in) :: X(*)
            integer(c_ptrdiff_t), value :: k
            integer(c_int), value :: measure
            type(c_ptr), value :: options
            type(batch_options), intent(in), optional :: batch
            real(c_double), intent(out) :: out(*)
            type(error_message), intent(out) :: error
        end function

        integer(c_int) function c_chaboche_voce(material, parameters, count, strain, n, stress, &
            slopes, error) bind(C, name="curvewise_chaboche_voce_stress")
            import :: c_double, c_int, c_ptrdiff_t, chaboche_voce, error_message
            type(chaboche_voce), intent(in) :: material
            real(c_double), intent(in) :: parameters(*), strain(*)
            integer(c_ptrdiff_t), value :: count, n
            real(c_double), intent(out) :: stress(*)
            real(c_double), intent(out), optional :: slopes(*)
            type(error_message), intent(out) :: error
        end function

        integer(c_int) function c_yoshida_uemori(material, parameters, count, strain, n, stress, &
            slopes, error) bind(C, name="curvewise_yoshida_uemori_stress")
            import :: c_double, c_int, c_ptrdiff_t, error_message, yoshida_uemori
            type(yoshida_uemori), intent(in) :: material
            real(c_double), intent(in) :: parameters(*), strain(*)
            integer(c_ptrdiff_t), value :: count, n
            real(c_double), intent(out) :: stress(*)
            real(c_double), intent(out), optional :: slopes(*)
            type(error_message), intent(out) :: error
        end function

        type(c_ptr) function c_version() bind(C, name="curvewise_version")
            import
        end function
    end interface

contains

    real(c_double) function area(P, Q, options, stat, errmsg) result(value)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        type(area_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(error_message) :: error
        value = 0
        call conclude(c_area(view(P), view(Q), options, value, error), error, stat, errmsg)
    end function

    real(c_double) function pcm(P, Q, options, stat, errmsg) result(value)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        type(pcm_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(error_message) :: error
        value = 0
        call conclude(c_pcm(view(P), view(Q), options, value, error), error, stat, errmsg)
    end function

    real(c_double) function frechet(P, Q, options, stat, errmsg) result(value)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        type(frechet_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(error_message) :: error
        value = 0
        call conclude(c_frechet(view(P), view(Q), options, value, error), error, stat, errmsg)
    end function

    real(c_double) function dtw(P, Q, options, stat, errmsg) result(value)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        type(dtw_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(error_message) :: error
        value = 0
        call conclude(c_dtw(view(P), view(Q), options, value, error), error, stat, errmsg)
    end function

    real(c_double) function curve_length(P, Q, options, stat, errmsg) result(value)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        type(curve_length_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(error_message) :: error
        value = 0
        call conclude(c_curve_length(view(P), view(Q), options, value, error), error, stat, errmsg)
    end function

    real(c_double) function frechet_continuous(P, Q, options, stat, errmsg) result(value)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        type(frechet_continuous_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(error_message) :: error
        value = 0
        call conclude(c_frechet_continuous(view(P), view(Q), options, value, error), error, &
            stat, errmsg)
    end function

    ! C minus P's minimum, divided by P's extent (where that is not 0), in `scaled`.
    subroutine normalize(P, C, scaled, stat, errmsg)
        real(c_double), intent(in) :: P(:, :), C(:, :)
        real(c_double), allocatable, intent(out) :: scaled(:, :)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(error_message) :: error
        real(c_double), allocatable :: points(:, :)  ! as C has them: coordinates by points
        allocate (points(size(C, 2), size(C, 1)))
        call conclude(c_normalize(view(P), view(C), points, error), error, stat, errmsg)
        scaled = transpose(points)
    end subroutine

    ! values(i, j) becomes the measure of XA(i) and XB(j). `options` is the c_loc of the measure's
    ! options, e.g. of a dtw_options for measure_dtw.
    subroutine cdist(XA, XB, measure, values, options, batch, stat, errmsg)
        type(curve_view), intent(in) :: XA(:), XB(:)
        integer(c_int), intent(in) :: measure
        real(c_double), allocatable, intent(out) :: values(:, :)
        type(c_ptr), intent(in), optional :: options
        type(batch_options), intent(in), optional :: batch
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(error_message) :: error
        real(c_double), allocatable :: rows(:, :)  ! as C has them
        allocate (rows(size(XB), size(XA)))
        call conclude(c_cdist(XA, size(XA, kind=c_ptrdiff_t), XB, size(XB, kind=c_ptrdiff_t), &
            measure, given(options), batch, rows, error), error, stat, errmsg)
        values = transpose(rows)
    end subroutine

    ! The measure of X(i) and X(j), i < j: (1, 2), (1, 3), ..., (2, 3), ... For symmetric measures.
    subroutine pdist(X, measure, values, options, batch, stat, errmsg)
        type(curve_view), intent(in) :: X(:)
        integer(c_int), intent(in) :: measure
        real(c_double), allocatable, intent(out) :: values(:)
        type(c_ptr), intent(in), optional :: options
        type(batch_options), intent(in), optional :: batch
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(error_message) :: error
        integer(c_ptrdiff_t) :: k
        k = size(X, kind=c_ptrdiff_t)
        allocate (values(k * (k - 1) / 2))
        call conclude(c_pdist(X, k, measure, given(options), batch, values, error), error, stat, &
            errmsg)
    end subroutine

    ! The stress at each strain of a path, by a point of material; slopes(j, i), where it is given,
    ! is the derivative of stress(i) by parameter j.
    subroutine chaboche_voce_stress(material, parameters, strain, stress, slopes, stat, errmsg)
        type(chaboche_voce), intent(in) :: material
        real(c_double), intent(in) :: parameters(:), strain(:)
        real(c_double), allocatable, intent(out) :: stress(:)
        real(c_double), allocatable, intent(out), optional :: slopes(:, :)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(error_message) :: error
        integer(c_ptrdiff_t) :: k, n
        k = size(parameters, kind=c_ptrdiff_t)
        n = size(strain, kind=c_ptrdiff_t)
        allocate (stress(n))
        if (present(slopes)) allocate (slopes(k, n))
        call conclude(c_chaboche_voce(material, parameters, k, strain, n, stress, slopes, error), &
            error, stat, errmsg)
    end subroutine

    subroutine yoshida_uemori_stress(material, parameters, strain, stress, slopes, stat, errmsg)
        type(yoshida_uemori), intent(in) :: material
        real(c_double), intent(in) :: parameters(:), strain(:)
        real(c_double), allocatable, intent(out) :: stress(:)
        real(c_double), allocatable, intent(out), optional :: slopes(:, :)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(error_message) :: error
        integer(c_ptrdiff_t) :: k, n
        k = size(parameters, kind=c_ptrdiff_t)
        n = size(strain, kind=c_ptrdiff_t)
        allocate (stress(n))
        if (present(slopes)) allocate (slopes(k, n))
        call conclude(c_yoshida_uemori(material, parameters, k, strain, n, stress, slopes, error), &
            error, stat, errmsg)
    end subroutine

    type(c_ptr) function given(options)
        type(c_ptr), intent(in), optional :: options
        given = c_null_ptr
        if (present(options)) given = options
    end function

    ! The version of the library that is linked, e.g. "0.1.0".
    function curvewise_version() result(version)
        character(:), allocatable :: version
        character(kind=c_char), pointer :: text(:)
        call c_f_pointer(c_version(), text, [32])
        version = as_string(text)
    end function

    function view(P)
        real(c_double), intent(in), target :: P(:, :)
        type(curve_view) :: view
        view%n = size(P, 1, c_ptrdiff_t)
        view%dim = size(P, 2, c_ptrdiff_t)
        if (size(P) == 0) return
        view%data = c_loc(P(1, 1))
        if (view%n > 1) view%row_stride = stride(P(1, 1), P(2, 1))
        if (view%dim > 1) view%col_stride = stride(P(1, 1), P(1, 2))
    end function

    ! The distance in memory between two elements, in doubles.
    integer(c_ptrdiff_t) function stride(a, b)
        real(c_double), intent(in), target :: a, b
        stride = (transfer(c_loc(b), 0_c_intptr_t) - transfer(c_loc(a), 0_c_intptr_t)) &
            / (storage_size(a) / 8)
    end function

    subroutine conclude(status, error, stat, errmsg)
        integer(c_int), intent(in) :: status
        type(error_message), intent(in) :: error
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        character(:), allocatable :: message
        message = as_string(error%text)
        if (present(stat)) stat = status
        if (status == 0) return
        if (present(errmsg)) errmsg = message
        if (.not. present(stat)) error stop message
    end subroutine

    function as_string(text) result(string)
        character(kind=c_char), intent(in) :: text(:)
        character(:), allocatable :: string
        integer :: i
        string = ''
        do i = 1, size(text)
            if (text(i) == c_null_char) exit
            string = string // text(i)
        end do
    end function
end module
