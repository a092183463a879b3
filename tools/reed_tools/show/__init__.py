"""How results look: pictures, tables, parts of a page."""
