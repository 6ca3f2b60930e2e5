"""Figures of tools/plot.py: what the program says about a recording over time, and joint angles.

`command` has the options and calls the rest. `calibration` and `angles` are one kind of figure
each, drawn on what `told`, `truth`, `motion` and `reading` read. `panels` has what panels share
(notes, log axes, legends, bands), `style` what a paper prescribes (size, font, file format),
`reduce` keeps long recordings small while they are read.
"""
