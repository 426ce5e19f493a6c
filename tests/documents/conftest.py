"""Starts of the program without what takes Open MPI longest; it changes no result: see end_to_end/launch.py. Each process of
pytest has a folder of its own for their sockets, as one start removes that folder while another makes it."""

import os
import tempfile

SOCKETS = tempfile.TemporaryDirectory(prefix="ompi-")
os.environ |= {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_orte_tmpdir_base": SOCKETS.name, "OMPI_MCA_pml": "ob1"}
