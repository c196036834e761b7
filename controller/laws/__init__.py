"""Force laws for one axis each, pure: readings and a reference in, a bounded step out."""
