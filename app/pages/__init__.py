"""What people look at: every page is a view of a case, generated from the schema.

query      the query string is the case
form       fields with what was typed, what they mean and what is wrong with them
results    headline numbers with verdicts, tables of results
charts     figures as images at addresses of their own, and their values
manual     chapters of the manual as pages, and what reports say of them
views      a case as asked for and its addresses; one view of one case, made in a worker
studies    pages of studies, whose results are drawn while they are calculated
"""
