"""The pages of the service. Most pages show a case, that is, a calculation with its inputs.

Pages that show a case are generated from the schema of the requests and answers.

typed        numbers as people type them, and the same numbers as texts in links
query        the query string that holds a case
form         the fields of a form with the typed text, the meaning and the fault of each field
asked        the case that a query or a form asks for
cases        a requested case, the addresses of its views, and its answer, which is kept for other views
results      the verdict, tiles, warnings, and tables of results
csv          an answer as a table for spreadsheets
carried      links that carry the gears or the coupling of a case to other calculations
charts       figures as images with their own addresses, and the values of the figures
manual       chapters of the manual as pages, and the parts of chapters that reports show
report       the parts of a report other than the result, and the case as program code
variants     three or more variants of a case in a small table
views        one view of a case (page, report, figure or file), made in a worker process
overview     pages that belong to no case
studies      pages of studies, drawn while the study is calculated
study_kinds  the kinds of study: links to their pages, and names of their controls
study_links  links to studies that are ready to run
templating   templates, and the addresses of pages
typesetting  symbols and numbers as they are printed
"""
