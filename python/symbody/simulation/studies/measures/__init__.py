"""Measures: functions of a motion that `study` computes for each case."""

from symbody.simulation.studies.measures.extremum import maximum, minimum
from symbody.simulation.studies.measures.final import final
from symbody.simulation.studies.measures.first_crossing import first_crossing
from symbody.simulation.studies.measures.integral import average, integral, rms
from symbody.simulation.studies.measures.measure import Measure
from symbody.simulation.studies.measures.time_above import settling_time, time_above
from symbody.simulation.studies.measures.value_at import value_at

__all__ = [
    "Measure",
    "average",
    "final",
    "first_crossing",
    "integral",
    "maximum",
    "minimum",
    "rms",
    "settling_time",
    "time_above",
    "value_at",
]
