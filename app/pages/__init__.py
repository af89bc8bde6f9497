"""What people look at: every page is a view of a case, generated from the schema.

typed      numbers as people type them, and their texts in links
query      the query string is the case
form       fields with what was typed, what they mean and what is wrong with them
cases      a requested case with the addresses of its views, and its answer, which is kept
results    headline numbers with verdicts, tables of results
verdicts   verdicts that compare several numbers, and the answer to the question of a calculation in one sentence
csv        an answer as a table for spreadsheets
carried    the gears or the coupling of a case in other calculations
charts     figures as images at addresses of their own, and their values
manual     chapters of the manual as pages, and what reports say of them
report     what reports say beside the result, and the case as code
variants   three or more variants of a case in a small table
views      one view of a case, made in a worker
overview   pages that belong to no case
studies    pages of studies, whose results are drawn while they are calculated; study_links: the links to them

templating and typesetting: addresses, templates, symbols and numbers as they are printed
"""
