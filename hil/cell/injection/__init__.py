"""Faults at their true places: devices that fail when the injector says so."""
