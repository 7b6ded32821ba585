"""The commands, one file each; `command` in it is what is called."""
