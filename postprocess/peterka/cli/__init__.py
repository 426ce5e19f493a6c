"""The programs, each a module whose docstring is its --help, and what they share: a Python that has the packages (interpreter),
exit codes, arguments and messages (command_line), what a journal asks of pictures (picture_options)."""

import os

# A run may still be writing a file; its readers must not be shut out by a lock, nor shut the run out. HDF5 looks when it is loaded.
os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")
