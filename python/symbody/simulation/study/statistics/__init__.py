"""Statistics of outputs over all cases of a `study`, at each instant."""

from symbody.simulation.study.statistics.covariance import covariance
from symbody.simulation.study.statistics.exceedance import exceedance
from symbody.simulation.study.statistics.extremes import extremes
from symbody.simulation.study.statistics.moments import moments
from symbody.simulation.study.statistics.quantiles import quantiles
from symbody.simulation.study.statistics.statistic import Statistic

__all__ = ["Statistic", "covariance", "exceedance", "extremes", "moments", "quantiles"]
