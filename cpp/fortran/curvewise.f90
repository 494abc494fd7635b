! curvewise for Fortran (2018): a module over the C interface, curvewise.h. A curve is an array
! P(n, d) of doubles, points by coordinates, or any section of one: strides are passed on, nothing
! is copied. The numbers are those of C++ and Python, to the last bit; the C++ header of each
! function has its definition, cost and errors.
!
!   use curvewise, only: dtw, dtw_options, symmetric2
!   value = dtw(experiment, simulation)
!   value = dtw(experiment, history(:, 2:3), dtw_options(step_pattern=symmetric2), stat, errmsg)
!
! As with allocate, an error is reported in stat (0: none) and errmsg if stat is given; otherwise it
! ends the program with the message. All functions may be called from any thread. Indices of points
! and curves begin at 1. Pass a `control` to watch and stop a call. The module is given as source,
! since a compiled one suits one compiler only: compile this file with your own, and link the
! library. curvewise_c.inc and curvewise_handles.inc belong to it.
module curvewise
    use, intrinsic :: iso_c_binding, only: c_char, c_double, c_f_pointer, c_funloc, c_funptr, &
        c_int, c_int64_t, c_intptr_t, c_loc, c_null_char, c_null_funptr, c_null_ptr, c_ptr, &
        c_ptrdiff_t, c_size_t, c_sizeof
    implicit none
    private
    public :: area, area_quads, cdist, compare, curve_length, curvewise_version, dtw, dtw_path, &
        frechet, frechet_continuous, frechet_path, material_response, material_stress, &
        normalize, pcm, pcm_match, pdist
    public :: report_progress

    integer(c_int), parameter, public :: euclidean = 0, sqeuclidean = 1, cityblock = 2, &
        chebyshev = 3, minkowski = 4, haversine = 5         ! metric
    ! step_pattern; the others by their places in c_options.h
    integer(c_int), parameter, public :: symmetric1 = 0, symmetric2 = 1
    integer(c_int), parameter, public :: spacing_distance = 0, spacing_x = 1, &
        spacing_arc_length = 2, spacing_matched = 3, spacing_function = 4        ! spacing
    integer(c_int), parameter, public :: rearrange = 0, split = 1, polygon = 2   ! crossing
    integer(c_int), parameter, public :: scale_mean = 0, scale_mean_abs = 1, scale_range = 2
    integer(c_ptrdiff_t), parameter, public :: no_window = -1
    integer(c_int), parameter, public :: preset_scaled = 0, preset_paper = 1, preset_raw = 2
    integer(c_int), parameter :: measure_area = 0, measure_pcm = 1, measure_frechet = 2, &
        measure_dtw = 3, measure_curve_length = 4, measure_frechet_continuous = 5
    integer(c_int), parameter, public :: invalid_argument = 1, no_memory = 2, failed = 3, &
        stopped = 4                                                              ! stat
    integer(c_int), parameter :: no_room = 5

    ! The options of a measure. For cdist, pdist, prepared_curve and curve_index, their type chooses
    ! the measure.
    type, abstract, public :: measure_options
    end type

    type, extends(measure_options), public :: area_options
        integer(c_int) :: spacing = spacing_distance
        integer(c_int) :: crossing = rearrange
        logical :: squared = .false.            ! sum the squared areas
        logical :: closed = .false.             ! join the ends of both curves
    end type

    type, extends(measure_options), public :: pcm_options
        integer(c_ptrdiff_t) :: offsets = 200   ! at least 1
        logical :: continuous = .false.         ! search all offsets
    end type

    type, extends(measure_options), public :: frechet_options
        integer(c_int) :: metric = euclidean
        real(c_double) :: p = 2                 ! the order of minkowski
        integer(c_ptrdiff_t) :: workers = 1     ! threads, -1 for one per core
        logical :: prune = .true.               ! skip cells that cannot affect the result
        real(c_double) :: cutoff = huge(1.0_c_double)  ! a value above it becomes infinity
        real(c_double) :: radius = 6371008.8_c_double  ! of the sphere of haversine
        logical :: closed = .false.             ! both curves are closed; not of many curves
    end type

    type, extends(measure_options), public :: dtw_options
        integer(c_int) :: metric = euclidean
        real(c_double) :: p = 2
        integer(c_int) :: step_pattern = symmetric1
        logical :: open_begin = .false.         ! P is matched to a section of Q
        logical :: open_end = .false.
        integer(c_ptrdiff_t) :: window = no_window
        integer(c_ptrdiff_t) :: workers = 1
        logical :: prune = .true.
        real(c_double) :: cutoff = huge(1.0_c_double)
        real(c_double) :: window_fraction = 0   ! not 0: of the longer curve's points, as window
        logical :: normalize = .false.          ! divide by the weight of all paths
        real(c_double) :: penalty = 0           ! of each step that leaves the diagonal
        real(c_double) :: radius = 6371008.8_c_double
        integer(c_ptrdiff_t) :: relax_p_begin = 0  ! maximum number of first points of P to omit
        integer(c_ptrdiff_t) :: relax_p_end = 0    ! maximum number of last points of P to omit
        integer(c_ptrdiff_t) :: relax_q_begin = 0  ! the same of Q
        integer(c_ptrdiff_t) :: relax_q_end = 0
        logical :: closed = .false.             ! both curves are closed; not of many curves
    end type

    type, extends(measure_options), public :: curve_length_options
        integer(c_int) :: scale = scale_mean
    end type

    type, extends(measure_options), public :: frechet_continuous_options
        integer(c_ptrdiff_t) :: workers = 1     ! threads, -1 for one per core
        logical :: closed = .false.             ! both curves are closed; not of many curves
    end type

    ! The result of compare. A measure of the plane is NaN if the curves have not two coordinates.
    type, public :: comparison
        real(c_double) :: area = 0, pcm = 0, frechet = 0, dtw = 0, curve_length = 0
    end type

    ! Where pcm places the shorter curve on the longer one, as PcmMatch in pcm.hpp.
    type, public :: pcm_place
        logical :: maps_p = .true.              ! whether P is the shorter curve
        real(c_double) :: value = 0, offset = 0, coverage = 0, tolerance = 0
    end type

    ! A curve among others, for lists of curves: curve_view(P). P is a variable with the attribute
    ! target, or a section of one. The compiler rejects an expression such as transpose(X), whose
    ! points would not outlive the statement.
    type, bind(C), public :: curve_view
        private
        type(c_ptr) :: data = c_null_ptr
        integer(c_ptrdiff_t) :: n, dim, row_stride = 1, col_stride = 1
    end type

    interface curve_view
        module procedure view_of_target
    end interface

    abstract interface
        ! The steps that are done, and all of the call. Returns whether to continue. The thread that
        ! made the call calls it, about once in `interval` milliseconds and once at the end.
        logical function report_progress(done, total)
            import :: c_int64_t
            integer(c_int64_t), intent(in) :: done, total
        end function
    end interface

    type :: reporter
        procedure(report_progress), pointer, nopass :: report => null()
    end type

    ! Watches a call and stops it: call control%create(), then dtw(P, Q, control=control). Another
    ! thread may call stop() and read done(). A control serves one call at a time. A control, a
    ! prepared_curve and a curve_index free their memory where they end. They cannot be assigned;
    ! pass them as arguments.
    type, public :: call_control
        private
        type(c_ptr) :: handle = c_null_ptr
        type(reporter), pointer :: reporter => null()
    contains
        procedure :: create => create_control   ! (report, interval, stat, errmsg)
        procedure :: stop => stop_control
        procedure :: stopped => control_stopped
        procedure :: done => control_done
        procedure :: total => control_total
        procedure, private :: refuse_control
        generic :: assignment(=) => refuse_control
        final :: destroy_control
    end type

    ! A curve P, checked, packed and scaled once, for comparison with others. It owns a copy of P.
    type, public :: prepared_curve
        private
        type(c_ptr) :: handle = c_null_ptr
    contains
        procedure :: prepare                    ! (P, options, stat, errmsg)
        procedure :: value => prepared_value    ! (Q, cutoff, stat, errmsg, control)
        procedure :: values => prepared_values  ! (Q, values, workers, cutoff, stat, errmsg, control)
        procedure, private :: refuse_prepared
        generic :: assignment(=) => refuse_prepared
        final :: destroy_prepared
    end type

    ! Curves to search for the nearest of other curves, as in nearest.hpp. It owns copies of them,
    ! numbered in the order in which they are added. The number of a curve never changes.
    type, public :: curve_index
        private
        type(c_ptr) :: handle = c_null_ptr
    contains
        procedure :: create => create_index     ! (curves, options, stat, errmsg, control)
        procedure :: add => add_curves          ! (curves, stat, errmsg, control)
        procedure :: remove => remove_curves    ! (indices, stat, errmsg)
        procedure :: size => index_size
        procedure :: indices => index_indices   ! (indices, stat, errmsg)
        procedure :: save => save_index         ! (path, stat, errmsg, control)
        procedure :: open => open_index         ! (path, options, stat, errmsg, control)
        ! (X, n_neighbors, distances, indices, workers, stat, errmsg, control)
        procedure :: kneighbors
        ! (X, radius, starts, distances, indices, workers, stat, errmsg, control)
        procedure :: radius_neighbors
        procedure, private :: refuse_index
        generic :: assignment(=) => refuse_index
        final :: destroy_index
    end type

    include 'curvewise_c.inc'

    ! A measure as C has it: its number, and the address of its options, which are one of these.
    type :: c_measure
        integer(c_int) :: number = 0
        type(c_ptr) :: options = c_null_ptr
        type(c_area_options) :: area
        type(c_pcm_options) :: pcm
        type(c_frechet_options) :: frechet
        type(c_dtw_options) :: dtw
        type(c_curve_length_options) :: curve_length
        type(c_frechet_continuous_options) :: frechet_continuous
    end type

contains

    real(c_double) function area(P, Q, options, stat, errmsg, control) result(value)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        type(area_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(call_control), intent(in), optional :: control
        type(area_options) :: chosen
        if (present(options)) chosen = options
        value = evaluated(P, Q, chosen, stat, errmsg, control)
    end function

    real(c_double) function pcm(P, Q, options, stat, errmsg, control) result(value)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        type(pcm_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(call_control), intent(in), optional :: control
        type(pcm_options) :: chosen
        if (present(options)) chosen = options
        value = evaluated(P, Q, chosen, stat, errmsg, control)
    end function

    real(c_double) function frechet(P, Q, options, stat, errmsg, control) result(value)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        type(frechet_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(call_control), intent(in), optional :: control
        type(frechet_options) :: chosen
        if (present(options)) chosen = options
        value = evaluated(P, Q, chosen, stat, errmsg, control)
    end function

    real(c_double) function dtw(P, Q, options, stat, errmsg, control) result(value)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        type(dtw_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(call_control), intent(in), optional :: control
        type(dtw_options) :: chosen
        if (present(options)) chosen = options
        value = evaluated(P, Q, chosen, stat, errmsg, control)
    end function

    real(c_double) function curve_length(P, Q, options, stat, errmsg, control) result(value)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        type(curve_length_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(call_control), intent(in), optional :: control
        type(curve_length_options) :: chosen
        if (present(options)) chosen = options
        value = evaluated(P, Q, chosen, stat, errmsg, control)
    end function

    real(c_double) function frechet_continuous(P, Q, options, stat, errmsg, control) result(value)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        type(frechet_continuous_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(call_control), intent(in), optional :: control
        type(frechet_continuous_options) :: chosen
        if (present(options)) chosen = options
        value = evaluated(P, Q, chosen, stat, errmsg, control)
    end function

    real(c_double) function evaluated(P, Q, options, stat, errmsg, control) result(value)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        class(measure_options), intent(in) :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(call_control), intent(in), optional :: control
        type(c_measure), target :: measure
        type(error_message) :: error
        value = 0
        call translate(options, measure, control)
        call conclude(c_evaluate(view(P), view(Q), measure%number, measure%options, value, error), &
            error, stat, errmsg)
    end function

    ! Several measures at once, under the conditions of a preset.
    type(comparison) function compare(P, Q, preset, stat, errmsg, control) result(found)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        integer(c_int), intent(in), optional :: preset
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(call_control), intent(in), optional :: control
        type(c_compare_options) :: options
        type(c_comparison) :: values
        type(error_message) :: error
        options = c_compare_options(0, handle_of(control), preset_scaled)
        options%size = c_sizeof(options)
        if (present(preset)) options%preset = preset
        values = c_comparison(0, 0.0_c_double, 0.0_c_double, 0.0_c_double, 0.0_c_double, &
            0.0_c_double)
        values%size = c_sizeof(values)
        call conclude(c_compare(view(P), view(Q), options, values, error), error, stat, errmsg)
        found = comparison(values%area, values%pcm, values%frechet, values%dtw, &
            values%curve_length)
    end function

    ! The distance, and the path that attains it: point path(1, k) of P is matched to point
    ! path(2, k) of Q.
    subroutine dtw_path(P, Q, distance, path, options, stat, errmsg, control)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        real(c_double), intent(out) :: distance
        integer(c_int64_t), allocatable, intent(out) :: path(:, :)
        type(dtw_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(call_control), intent(in), optional :: control
        type(dtw_options) :: chosen
        if (present(options)) chosen = options
        call find_path(P, Q, distance, path, chosen, stat, errmsg, control)
    end subroutine

    subroutine frechet_path(P, Q, distance, path, options, stat, errmsg, control)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        real(c_double), intent(out) :: distance
        integer(c_int64_t), allocatable, intent(out) :: path(:, :)
        type(frechet_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(call_control), intent(in), optional :: control
        type(frechet_options) :: chosen
        if (present(options)) chosen = options
        call find_path(P, Q, distance, path, chosen, stat, errmsg, control)
    end subroutine

    subroutine find_path(P, Q, distance, path, options, stat, errmsg, control)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        real(c_double), intent(out) :: distance
        integer(c_int64_t), allocatable, intent(out) :: path(:, :)
        class(measure_options), intent(in) :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(call_control), intent(in), optional :: control
        type(c_measure), target :: measure
        type(error_message) :: error
        integer(c_int64_t), allocatable :: pairs(:, :)
        integer(c_ptrdiff_t) :: capacity, count
        integer(c_int) :: status
        call translate(options, measure, control)
        distance = 0
        count = 0
        capacity = size(P, 1, c_ptrdiff_t) + size(Q, 1, c_ptrdiff_t)
        allocate (pairs(2, capacity))
        if (measure%number == measure_dtw) then
            status = c_dtw_path(view(P), view(Q), measure%options, distance, pairs, capacity, &
                count, error)
        else
            status = c_frechet_path(view(P), view(Q), measure%options, distance, pairs, capacity, &
                count, error)
        end if
        path = pairs(:, :count) + 1
        call conclude(status, error, stat, errmsg)
    end subroutine

    ! The measure of pcm, where it is attained, and the points of the shorter curve at their places
    ! on the longer one.
    subroutine pcm_match(P, Q, place, points, options, stat, errmsg, control)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        type(pcm_place), intent(out) :: place
        real(c_double), allocatable, intent(out) :: points(:, :)
        type(pcm_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(call_control), intent(in), optional :: control
        type(pcm_options) :: chosen
        type(c_measure), target :: measure
        type(c_pcm_place) :: found
        type(error_message) :: error
        real(c_double), allocatable :: rows(:, :)  ! as C has them: coordinates by points
        integer(c_ptrdiff_t) :: capacity, count
        integer(c_int) :: status
        if (present(options)) chosen = options
        call translate(chosen, measure, control)
        found = c_pcm_place(0, 0, 0.0_c_double, 0.0_c_double, 0.0_c_double, 0.0_c_double)
        found%size = c_sizeof(found)
        count = 0
        capacity = max(size(P, 1, c_ptrdiff_t), size(Q, 1, c_ptrdiff_t))
        allocate (rows(2, capacity))
        status = c_pcm_match(view(P), view(Q), measure%options, found, rows, capacity, count, error)
        place = pcm_place(found%maps_p /= 0, found%value, found%offset, found%coverage, &
            found%tolerance)
        points = transpose(rows(:, :count))
        call conclude(status, error, stat, errmsg)
    end subroutine

    ! The quadrilaterals of area: quads(c, v, k) is coordinate c of vertex v, areas(k) the area.
    subroutine area_quads(P, Q, quads, areas, options, stat, errmsg, control)
        real(c_double), intent(in) :: P(:, :), Q(:, :)
        real(c_double), allocatable, intent(out) :: quads(:, :, :), areas(:)
        type(area_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(call_control), intent(in), optional :: control
        type(area_options) :: chosen
        type(c_measure), target :: measure
        type(error_message) :: error
        integer(c_ptrdiff_t) :: count
        integer(c_int) :: status
        if (present(options)) chosen = options
        call translate(chosen, measure, control)
        count = 0
        status = c_area_quads(view(P), view(Q), measure%options, count=count, &
            capacity=0_c_ptrdiff_t, error=error)
        allocate (quads(2, 4, count), areas(count))
        if (status == 0) status = c_area_quads(view(P), view(Q), measure%options, quads, areas, &
            count, count, error)
        call conclude(status, error, stat, errmsg)
    end subroutine

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

    ! values(i, j) becomes the measure of XA(i) and XB(j): call cdist(XA, XB, dtw_options(), values).
    subroutine cdist(XA, XB, options, values, workers, cutoff, stat, errmsg, control)
        type(curve_view), intent(in) :: XA(:), XB(:)
        class(measure_options), intent(in) :: options
        real(c_double), allocatable, intent(out) :: values(:, :)
        integer, intent(in), optional :: workers
        real(c_double), intent(in), optional :: cutoff
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(call_control), intent(in), optional :: control
        type(c_measure), target :: measure
        type(error_message) :: error
        real(c_double), allocatable :: rows(:, :)  ! as C has them
        call translate(options, measure)
        allocate (rows(size(XB), size(XA)))
        call conclude(c_cdist(XA, size(XA, kind=c_ptrdiff_t), XB, size(XB, kind=c_ptrdiff_t), &
            measure%number, measure%options, batch(workers, cutoff, control), rows, error), &
            error, stat, errmsg)
        values = transpose(rows)
    end subroutine

    ! The measure of X(i) and X(j), i < j: (1, 2), (1, 3), ..., (2, 3), ... For symmetric measures.
    subroutine pdist(X, options, values, workers, cutoff, stat, errmsg, control)
        type(curve_view), intent(in) :: X(:)
        class(measure_options), intent(in) :: options
        real(c_double), allocatable, intent(out) :: values(:)
        integer, intent(in), optional :: workers
        real(c_double), intent(in), optional :: cutoff
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(call_control), intent(in), optional :: control
        type(c_measure), target :: measure
        type(error_message) :: error
        integer(c_ptrdiff_t) :: k
        call translate(options, measure)
        k = size(X, kind=c_ptrdiff_t)
        allocate (values(k * (k - 1) / 2))
        call conclude(c_pdist(X, k, measure%number, measure%options, &
            batch(workers, cutoff, control), values, error), error, stat, errmsg)
    end subroutine

    include 'curvewise_handles.inc'
    include 'curvewise_materials.inc'
    include 'curvewise_translation.inc'
end module
