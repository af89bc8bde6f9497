"""The code that the pages of all studies share; the code of each kind of study is in `app.studies.kinds`.

controls        the controls of a form, and the parts of the request body that they set
page            the page before, during and after the calculation; made in workers
stream          the page and the report, sent in parts while the study runs
"""
