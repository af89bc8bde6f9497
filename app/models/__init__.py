"""One folder per model, with all that `app` knows about it.

request     sections of the request; those without validators are generated
words       components of the answer, views and limits, verdicts, conclusions, what studies and files take
figures     figures of the answers
chapter.md  theory
examples    cases, and studies of them
__init__    CARD: endpoints with solver, request, answer, figures and words

card        what a card consists of
kernels     groups of compiled functions that the endpoints need
sections    sections that several requests share
"""
