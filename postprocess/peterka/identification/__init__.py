"""Identifies the stop and the springs from measurements: a recording of impacts, or measured properties of single impacts.

`contact_pulse` maps stop parameters to restitution and contact time in closed form, and back; `recording` holds evenly sampled signals,
`recorded_file` reads them, of which `columns` says what a column is and `recorded_formats` reads files that are no text; `samples` thins
them between impacts; `motion` is the hammer's motion, piecewise in closed form; `first_guess` detects the impacts and refuses recordings
without any; `starts` fits single impacts, `flights` finds springs and gap from the flights between them; `problem` and `solve` are the
least-squares problem and its solution, `fit` fits a whole release, `twins` tells apart rigs that meet the same impacts, `driven` fits the
impacts of a driven hammer; `flights_alone` tells the stop, or a bound of ki, where contacts have too few samples;
`adequacy` refuses recordings of a different motion; `one_mode` tells whether the hammer is one mass;
`impact_table` derives the stop from measured restitutions and contact times; `picture`, `rig_file` and `words` report the results.
"""
