"""Its place puts the folder above on the import path: every test finds `tests.helpers`."""
