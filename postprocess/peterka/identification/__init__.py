"""The stop and the springs from measurements: a recording of impacts, or what somebody measured of single ones.

`contact_pulse` is one impact in closed form, there and back; `recording` reads a CSV file; `release_motion` is the motion of
a hammer over a cart at rest, piece by piece in closed form; `first_guess` looks for the impacts and refuses what shows none;
`fit` finds the parameters and their standard errors; `impact_table` takes them from measured restitutions and contact times;
`picture`, `rig_file` and `words` tell what came out.
"""
