"""Starts of the program without what takes Open MPI longest; it changes no result: see end_to_end/launch.py."""

import os

os.environ |= {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_pml": "ob1"}
