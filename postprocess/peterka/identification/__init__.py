"""The stop and the springs from measurements: a recording of impacts, or what somebody measured of single ones.

`contact_pulse` is one impact in closed form, there and back; `recording` is evenly sampled signals, `recorded_file` reads them from CSV,
`samples` thins them between impacts; `motion` is a hammer's, piece by piece in closed form; `first_guess` looks for the impacts and
refuses what shows none; `starts` fits them by themselves, `flights` finds springs and gap between them; `problem` and `solve` are the
least squares, `fit` of a release as a whole, `driven` of impacts of a hammer that something moves; `adequacy` refuses what is another
motion; `impact_table` takes the stop from measured restitutions and contact times; `picture`, `rig_file` and `words` tell what came out.
"""
