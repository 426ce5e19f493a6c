"""What the programs share: a Python that has the packages (interpreter), exit codes, arguments and messages
(command_line), what a journal asks of pictures (picture_options)."""
