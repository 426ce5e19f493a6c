"""Shared by the programs: an interpreter that has the packages (interpreter), exit codes, arguments and messages
(command_line), options that journals require of pictures (picture_options)."""
