"""The theory manual: chapters in Markdown beside this file.

`chapters` reads them, `equations` finds their numbered equations and the functions that implement them;
`app.pages.manual` makes pages of them.
"""
