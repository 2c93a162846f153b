"""Measures: functions of a motion that `study` computes for each case."""

from symbody.simulation.study.measures.extremum import maximum, minimum
from symbody.simulation.study.measures.final import final
from symbody.simulation.study.measures.first_crossing import first_crossing
from symbody.simulation.study.measures.integral import average, integral, rms
from symbody.simulation.study.measures.measure import Measure
from symbody.simulation.study.measures.time_above import settling_time, time_above
from symbody.simulation.study.measures.value_at import value_at

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
