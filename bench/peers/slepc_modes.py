# SPDX-License-Identifier: GPL-3.0-or-later
"""slepc_modes.py COUNT TOLERANCE [HZ]: the lowest modes of block.K.npz, block.M.npz [Hz] by SLEPc with MUMPS. With HZ all
modes below it by spectrum slicing, which counts them by inertia. Under mpirun each process has some of the rows."""
import glob
import sys

import numpy as np

# Debian installs both builds (real, complex) outside of Python's path.
sys.path += glob.glob("/usr/lib/*dir/*/*-real/lib/python3/dist-packages")
import slepc4py  # noqa: E402

slepc4py.init()
from petsc4py import PETSc  # noqa: E402
from slepc4py import SLEPc  # noqa: E402

for prefix in ("", "st_", "eps_"):  # METIS; one process: inertia of the root; detection of null pivots, as slicing requires
    for name, value in (("icntl_7", 5), ("icntl_13", 1), ("icntl_24", 1)):
        PETSc.Options().setValue(f"{prefix}mat_mumps_{name}", value)


COMM = PETSc.COMM_WORLD


def matrix(name):
    with np.load(f"block.{name}.npz") as f:
        index, starts, n = PETSc.IntType, f["indptr"], int(f["shape"][0])
        begin, end = (n * part // COMM.size for part in (COMM.rank, COMM.rank + 1))
        own = slice(starts[begin], starts[end])
        rows = (starts[begin:end + 1] - starts[begin]).astype(index), f["indices"][own].astype(index), f["data"][own]
        A = PETSc.Mat().createAIJ(size=((end - begin, n), (end - begin, n)), csr=rows)
    A.setOption(PETSc.Mat.Option.SYMMETRIC, True)
    return A


eps = SLEPc.EPS().create()
eps.setOperators(matrix("K"), matrix("M"))
eps.setProblemType(SLEPc.EPS.ProblemType.GHEP)
eps.setType(SLEPc.EPS.Type.KRYLOVSCHUR)
eps.setTolerances(float(sys.argv[2]))
st = eps.getST()
st.setType(SLEPc.ST.Type.SINVERT)
ksp = st.getKSP()
ksp.setType("preonly")
shift = -(2 * np.pi * 100.0) ** 2
if len(sys.argv) > 3:
    eps.setWhichEigenpairs(SLEPc.EPS.Which.ALL)
    eps.setInterval(shift, (2 * np.pi * float(sys.argv[3])) ** 2)
    if hasattr(eps, "setKrylovSchurDetectZeros"):
        eps.setKrylovSchurDetectZeros(True)
    ksp = eps.getKrylovSchurKSP()
    ksp.setType("preonly")
    ksp.getPC().setType("cholesky")
    ksp.getPC().setFactorSolverType("mumps")
else:
    eps.setDimensions(int(sys.argv[1]))
    eps.setTarget(shift)
    eps.setWhichEigenpairs(SLEPc.EPS.Which.TARGET_MAGNITUDE)
    ksp.getPC().setType("cholesky")
    ksp.getPC().setFactorSolverType("mumps")
eps.solve()
values = np.sort([eps.getEigenvalue(j).real for j in range(eps.getConverged())])
if COMM.rank == 0:
    print(*np.sqrt(np.abs(values)) / (2 * np.pi))
