"""The code that the pages of all studies share; the code of each kind of study is in `app.studies.kinds`.

controls        the controls of a form and the parts of the body that they set, in one list
page            the page before, during and after the calculation; made in workers
stream          the page while its lines arrive
"""
