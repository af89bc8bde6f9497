"""The common part of the pages of studies; the parts of each kind are in `app.studies.kinds`.

controls        the controls of a form and the parts of the body that they set, in one list
page            the page before, during and after the calculation; made in workers
stream          the page while its lines arrive
"""
