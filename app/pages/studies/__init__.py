"""Pages of studies, each below that of the case.

page            what they share: before, during and after the calculation; made in workers
stream          the page while its lines arrive
sweep           one field or two varied
spectrum        a load spectrum with tolerances: probabilities and losses
sensitivity     which input moves an output most
corners         the worst combination of uncertain inputs
design          the flank correction whose worst corner is best
"""

from app.pages.studies.corners import CornersPage
from app.pages.studies.design import DesignPage
from app.pages.studies.page import StudyPage
from app.pages.studies.sensitivity import SensitivityPage
from app.pages.studies.spectrum import SpectrumPage
from app.pages.studies.sweep import SweepPage

KINDS: tuple[type[StudyPage], ...] = (SweepPage, SensitivityPage, SpectrumPage, CornersPage, DesignPage)
PAGES = {each.link: each for each in KINDS}
