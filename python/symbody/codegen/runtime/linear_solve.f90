! Linear systems A x = b. The workspace, of 2 n n + 5 n + 1 numbers, holds A row by row before symbody_factor and its
! factorisation afterwards; symbody_solve puts x in the place of b. Each equation is divided by the power of two below
! its largest coefficient. A = P L U by partial pivoting; where a pivot vanishes against its column, A P = Q [R S; 0 0]
! by reflections, with the largest columns first (Golub & Van Loan, Matrix Computations, 4th ed., 3.4 and 5.4.2): of
! the x that fit best the least is taken, by removing its part along the directions in which nothing changes. The last
! number is then the rank; where it is less than n, the n numbers before it mark with 1 the equations that follow from
! the others. NaN in, NaN out. In what follows f(:, i) is row i.
pure subroutine symbody_factor(n, work)
    integer, intent(in) :: n
    real(dp), intent(inout) :: work(2*n*n + 5*n + 1)
    integer :: f, v
    f = n*n + 1
    v = 2*n*n + 1
    call symbody_decompose(n, work(1), work(f), work(v), work(v + n), work(v + 2*n), work(v + 3*n), &
                           work(v + 4*n), work(v + 5*n))
end subroutine symbody_factor

pure subroutine symbody_solve(n, work, x)
    integer, intent(in) :: n
    real(dp), intent(in) :: work(2*n*n + 5*n + 1)
    real(dp), intent(inout) :: x(n)
    integer :: f, v
    f = n*n + 1
    v = 2*n*n + 1
    x = x*work(v:v + n - 1)
    if (work(v + 5*n) == -1.0_dp) then
        call symbody_solve_triangular(n, work(f), work(v + n), work(v + 2*n), x)
    else if (work(v + 5*n) >= 0.0_dp) then
        call symbody_solve_orthogonal(n, int(work(v + 5*n)), work(1), work(f), work(v + n), work(v + 2*n), &
                                      work(v + 3*n), x)
    else
        x = work(v + 5*n)
    end if
end subroutine symbody_solve

pure subroutine symbody_decompose(n, a, f, weight, swap, pivot, unit, column, state)
    integer, intent(in) :: n
    real(dp), intent(inout) :: a(n, n)
    real(dp), intent(out) :: f(n, n), weight(n), swap(n), pivot(n), unit(n), column(n), state
    integer :: i, rank
    logical :: certain
    call symbody_weigh(n, a, f, weight, column)
    state = -1.0_dp
    call symbody_eliminate(n, f, swap, pivot, column, certain)
    if (certain) return
    state = sum(0.0_dp*a)
    if (.not. state == 0.0_dp) return
    call symbody_take_units(n, a, unit, pivot)
    call symbody_weigh(n, a, f, weight, column)
    column = symbody_weight(column)
    do i = 1, n
        f(:, i) = f(:, i)*column
    end do
    column = column*unit
    call symbody_reflect_columns(n, f, swap, pivot, unit, column, rank)
    state = rank
    unit = column
    if (rank == n) return
    call symbody_mark(n, rank, f, a, pivot, column)
    call symbody_find_directions(n, rank, f, unit, a)
end subroutine symbody_decompose

! The power of two that brings a magnitude into [1, 2); 1 for nothing.
elemental real(dp) function symbody_weight(magnitude) result(weight)
    real(dp), intent(in) :: magnitude
    if (magnitude < tiny(1.0_dp)) then
        weight = 1.0_dp
    else if (magnitude <= huge(1.0_dp)) then
        weight = scale(1.0_dp, 1 - exponent(magnitude))
    else
        weight = magnitude - magnitude
    end if
end function symbody_weight

! Copy the equations, each times its weight; find the largest coefficients of the columns.
pure subroutine symbody_weigh(n, a, f, weight, column)
    integer, intent(in) :: n
    real(dp), intent(in) :: a(n, n)
    real(dp), intent(out) :: f(n, n), weight(n), column(n)
    real(dp) :: most
    integer :: i, j
    column = 0.0_dp
    do i = 1, n
        most = 0.0_dp
        do j = 1, n
            if (abs(a(j, i)) > most) most = abs(a(j, i))
        end do
        weight(i) = symbody_weight(most)
        f(:, i) = a(:, i)*weight(i)
        column = merge(abs(f(:, i)), column, abs(f(:, i)) > column)
    end do
end subroutine symbody_weigh

! Measure the unknowns in units, powers of 2^20, that bring the coefficients of each equation closer together: masses
! may be small against the geometry in constraints, and are none the less no rounding errors.
pure subroutine symbody_take_units(n, a, unit, middle)
    integer, intent(in) :: n
    real(dp), intent(inout) :: a(n, n)
    real(dp), intent(out) :: unit(n), middle(n)
    integer :: i, pass
    unit = 1.0_dp
    do pass = 1, 3
        do i = 1, n
            middle(i) = symbody_middle(abs(a(:, i)*unit))
        end do
        do i = 1, n
            unit(i) = 1.0_dp/symbody_middle(abs(a(i, :)/middle))
        end do
    end do
    unit = scale(1.0_dp, 20*nint(log(unit)/(20*log(2.0_dp))))
    do i = 1, n
        a(:, i) = a(:, i)*unit
    end do
end subroutine symbody_take_units

! The geometric mean of the largest and the least magnitude that is not 0; 1 if there is none.
pure real(dp) function symbody_middle(sizes)
    real(dp), intent(in) :: sizes(:)
    symbody_middle = 1.0_dp
    if (any(sizes > 0.0_dp)) symbody_middle = sqrt(minval(sizes, sizes > 0.0_dp))*sqrt(maxval(sizes))
end function symbody_middle

! P A = L U in place; not certain where a pivot is so small against its column that it may be a rounding error.
pure subroutine symbody_eliminate(n, f, swap, pivot, column, certain)
    integer, intent(in) :: n
    real(dp), intent(inout) :: f(n, n)
    real(dp), intent(in) :: column(n)
    real(dp), intent(out) :: swap(n), pivot(n)
    logical, intent(out) :: certain
    integer :: i, k, best
    do k = 1, n
        best = k
        do i = k + 1, n
            if (abs(f(k, i)) > abs(f(k, best))) best = i
        end do
        certain = abs(f(k, best)) > 1e-11_dp*column(k)
        if (.not. certain) return
        swap(k) = best
        if (best > k) call symbody_swap(f(:, k), f(:, best))
        pivot(k) = 1.0_dp/f(k, k)
        do i = k + 1, n
            f(k, i) = f(k, i)*pivot(k)
            if (f(k, i) /= 0.0_dp) f(k + 1:, i) = f(k + 1:, i) - f(k, i)*f(k + 1:, k)
        end do
    end do
    certain = .true.
end subroutine symbody_eliminate

elemental subroutine symbody_swap(x, y)
    real(dp), intent(inout) :: x, y
    real(dp) :: kept
    kept = x
    x = y
    y = kept
end subroutine symbody_swap

! A P = Q R by reflections of the columns, the longest first, until rounding errors are left.
pure subroutine symbody_reflect_columns(n, f, swap, tau, sums, column, rank)
    integer, intent(in) :: n
    real(dp), intent(inout) :: f(n, n), swap(n), tau(n), sums(n), column(n)
    integer, intent(out) :: rank
    real(dp) :: norm, first, along
    integer :: i, k, longest
    first = 0.0_dp
    do rank = 0, n - 1
        k = rank + 1
        sums(k:) = 0.0_dp
        do i = k, n
            sums(k:) = sums(k:) + f(k:, i)**2
        end do
        longest = rank + maxloc(sums(k:), 1)
        norm = sqrt(sums(longest))
        if (k == 1) first = norm
        if (norm <= 64*epsilon(norm)*n*first) exit
        swap(k) = longest
        if (longest > k) then
            call symbody_swap(column(k), column(longest))
            call symbody_swap(f(k, :), f(longest, :))
        end if
        norm = -sign(norm, f(k, k))
        tau(k) = (norm - f(k, k))/norm
        along = f(k, k) - norm
        f(k, k) = norm
        sums(k + 1:) = f(k + 1:, k)
        do i = k + 1, n
            f(k, i) = f(k, i)/along
            sums(k + 1:) = sums(k + 1:) + f(k, i)*f(k + 1:, i)
        end do
        f(k + 1:, k) = f(k + 1:, k) - tau(k)*sums(k + 1:)
        do i = k + 1, n
            f(k + 1:, i) = f(k + 1:, i) - (tau(k)*f(k, i))*sums(k + 1:)
        end do
    end do
end subroutine symbody_reflect_columns

! R x = b in place, with 0 from the rank on.
pure subroutine symbody_back_substitute(n, rank, f, x)
    integer, intent(in) :: n, rank
    real(dp), intent(in) :: f(n, n)
    real(dp), intent(inout) :: x(n)
    integer :: k
    do k = rank, 1, -1
        x(k) = (x(k) - dot_product(f(k + 1:, k), x(k + 1:)))/f(k, k)
    end do
end subroutine symbody_back_substitute

! Orthonormal directions of x in which nothing changes: [-R^-1 S; 1], without what is rounding error in them.
pure subroutine symbody_find_directions(n, rank, f, unit, direction)
    integer, intent(in) :: n, rank
    real(dp), intent(in) :: f(n, n), unit(n)
    real(dp), intent(out) :: direction(n, n - rank)
    integer :: c, k
    direction = 0.0_dp
    do c = 1, n - rank
        direction(rank + c, c) = 1.0_dp
        call symbody_back_substitute(n, rank, f, direction(:, c))
        where (abs(direction(:, c)) <= 64*epsilon(1.0_dp)*n*maxval(abs(direction(:, c)))) direction(:, c) = 0.0_dp
        direction(:, c) = direction(:, c)*unit
        direction(:, c) = direction(:, c)/norm2(direction(:, c))
        do k = 1, 2*(c - 1)
            call symbody_remove(direction(:, 1 + mod(k - 1, c - 1)), direction(:, c))
        end do
        direction(:, c) = direction(:, c)/norm2(direction(:, c))
    end do
end subroutine symbody_find_directions

! Remove the part of x along a direction.
pure subroutine symbody_remove(direction, x)
    real(dp), intent(in) :: direction(:)
    real(dp), intent(inout) :: x(:)
    x = x - dot_product(direction, x)*direction
end subroutine symbody_remove

! Mark the equations that follow from the others, late ones rather than early ones: the last columns of Q are the
! combinations c of equations that vanish; elimination leaves each of them an equation.
pure subroutine symbody_mark(n, rank, f, c, tau, mark)
    integer, intent(in) :: n, rank
    real(dp), intent(in) :: f(n, n), tau(n)
    real(dp), intent(out) :: c(n - rank, n), mark(n)
    real(dp) :: sums(n - rank)
    integer :: i, j, k, late, pivot
    c = 0.0_dp
    mark = 0.0_dp
    do j = 1, n - rank
        c(j, rank + j) = 1.0_dp
    end do
    do k = rank, 1, -1
        sums = c(:, k)
        do i = k + 1, n
            sums = sums + f(k, i)*c(:, i)
        end do
        c(:, k) = c(:, k) - tau(k)*sums
        do i = k + 1, n
            c(:, i) = c(:, i) - (tau(k)*f(k, i))*sums
        end do
    end do
    do j = 1, n - rank
        do late = n, 2, -1
            if (maxval(abs(c(j:, late))) >= 1e-3_dp*maxval(abs(c(j:, :)))) exit
        end do
        mark(late) = 1.0_dp
        pivot = j - 1 + maxloc(abs(c(j:, late)), 1)
        if (pivot > j) call symbody_swap(c(j, :), c(pivot, :))
        do k = j + 1, n - rank
            c(k, :) = c(k, :) - (c(k, late)/c(j, late))*c(j, :)
        end do
    end do
end subroutine symbody_mark

pure subroutine symbody_solve_triangular(n, f, swap, pivot, x)
    integer, intent(in) :: n
    real(dp), intent(in) :: f(n, n), swap(n), pivot(n)
    real(dp), intent(inout) :: x(n)
    real(dp) :: kept
    integer :: k
    do k = 1, n
        kept = x(int(swap(k)))
        x(int(swap(k))) = x(k)
        x(k) = kept
    end do
    do k = 2, n
        x(k) = x(k) - dot_product(f(:k - 1, k), x(:k - 1))
    end do
    do k = n, 1, -1
        x(k) = (x(k) - dot_product(f(k + 1:, k), x(k + 1:)))*pivot(k)
    end do
end subroutine symbody_solve_triangular

pure subroutine symbody_solve_orthogonal(n, rank, direction, f, swap, tau, unit, x)
    integer, intent(in) :: n, rank
    real(dp), intent(in) :: direction(n, n - rank), f(n, n), swap(n), tau(n), unit(n)
    real(dp), intent(inout) :: x(n)
    real(dp) :: along, kept
    integer :: c, k
    do k = 1, rank
        along = tau(k)*(x(k) + dot_product(f(k, k + 1:), x(k + 1:)))
        x(k) = x(k) - along
        x(k + 1:) = x(k + 1:) - along*f(k, k + 1:)
    end do
    ! NaN in b must survive, although equations are left out.
    x(rank + 1:) = sum(0.0_dp*x(rank + 1:))
    call symbody_back_substitute(n, rank, f, x)
    x = x*unit
    ! Twice, because what is removed may be much larger than what stays.
    do c = 1, 2*(n - rank)
        call symbody_remove(direction(:, 1 + mod(c - 1, n - rank)), x)
    end do
    do k = rank, 1, -1
        kept = x(int(swap(k)))
        x(int(swap(k))) = x(k)
        x(k) = kept
    end do
end subroutine symbody_solve_orthogonal
