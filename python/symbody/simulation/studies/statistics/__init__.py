"""Statistics of outputs over all cases of a `study`, at each instant."""

from symbody.simulation.studies.statistics.covariance import covariance
from symbody.simulation.studies.statistics.exceedance import exceedance
from symbody.simulation.studies.statistics.extremes import extremes
from symbody.simulation.studies.statistics.moments import moments
from symbody.simulation.studies.statistics.quantiles import quantiles
from symbody.simulation.studies.statistics.statistic import Statistic

__all__ = ["Statistic", "covariance", "exceedance", "extremes", "moments", "quantiles"]
