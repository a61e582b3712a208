"""The lab in a browser: one file that runs the lab's own definitions, with nothing installed.

javascript  Python's text of loops over numbers as JavaScript
programs    schemes, the spring's law and obstacles, each from its one definition
spring_laws the law of springs that are not linear, of numbers that write themselves
system_data systems and scenes as the page reads them
changes     what changes on the way, a truck that crosses and ground that shakes too
engines     those that step in the page themselves
recordings  engines' runs, quantised, that the page lays over its own
presets     which scenes there are where none is named
lab_page    all of it, with the page's own scripts, in one file

The page's own scripts and words stand in report/templates/browser.
"""
