"""Commands that Maple has and that are missing here: a call comes back as it was written, with a note that says so."""

from __future__ import annotations

__all__ = ["MISSING"]

_BY_PURPOSE = {
    "solving and analysis": (
        "eliminate isolve msolve rsolve pdsolve odetest discont extrema interp spline fourier invfourier "
        "laurent asympt singular residue numapprox chebyshev pade minimax implicitdiff plotcompare"
    ),
    "forms": (
        "verify "
        "coeftayl gcdex "
        "frontend powsubs trigsubs radnormal compoly sqrfree resultant discrim sturm realroot content "
        "primpart prem divide roots irreduc completesquare asubs shake evalr"
    ),
    "assumptions": "about coulditbe property",
    "numbers": (
        "isqrt iroot symmdiff polar "
        "ifactors divisors primes rand randpoly randmatrix GAMMA Beta Zeta erf "
        "erfc BesselJ BesselY EllipticF EllipticK EllipticE LambertW Dirac Si Ci Ei arcsec arccsc arcsinh "
        "arccosh arctanh sech csch coth"
    ),
    "matrices": (
        "toeplitz vandermonde wronskian QRdecomp "
        "LUdecomp cholesky svd singularvals rowspan colspan "
        "JordanForm LUDecomposition QRDecomposition SingularValues ConditionNumber "
        "ConstantVector MatrixFunction MatrixExponential RandomMatrix RandomVector BandMatrix ToeplitzMatrix "
        "HilbertMatrix HessianMatrix CompanionMatrix MinimalPolynomial SchurForm "
        "GramSchmidt LeastSquares ColumnSpace RowSpace SumBasis "
        "IntersectionBasis IsDefinite IsOrthogonal IsUnitary JordanBlockMatrix "
        "Permanent KroneckerProduct exponential jordan frobenius hadamard "
        "orthog definite iszero cond backsub forwardsub copyinto colspace rowspace leastsqrs htranspose hilbert"
    ),
    "pictures": (
        "phaseportrait DEplot fieldplot contourplot densityplot tubeplot animate3d matrixplot inequal "
        "conformal replot"
    ),
    "texts and files": "latex fscanf scanf readdata writedata writeto appendto",
    "the system": "randomize process tracelast debug showstat stopat profile iostatus",
}
"""Their names, by what they are for. A name that gets a command leaves this table."""

MISSING = frozenset(name for names in _BY_PURPOSE.values() for name in names.split())
