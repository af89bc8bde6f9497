"""The pages of studies: a module for each kind of study, and what they share.

sweep, solve_for, sensitivity, spectrum, corners, design   the page of the kind of study in `app.studies.kinds`
price           how exactly to grind, on the page of the design study
load_cases      the table of cases on the page of a load spectrum
unit            what the pages of studies of a gear unit share
controls        the controls of a form, and the parts of the request body that they set
page            the page before, during and after the calculation; made in workers
stream          the page and the report, sent in parts while the study runs
"""

from app.pages.studies.corners import CornersPage
from app.pages.studies.design import DesignPage
from app.pages.studies.page import StudyPage
from app.pages.studies.sensitivity import SensitivityPage
from app.pages.studies.solve_for import SolveForPage
from app.pages.studies.spectrum import SpectrumPage
from app.pages.studies.sweep import SweepPage

PAGES: tuple[type[StudyPage], ...] = (SweepPage, SolveForPage, SensitivityPage, SpectrumPage, CornersPage, DesignPage)
"""The pages of the kinds of study."""
