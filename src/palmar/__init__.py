"""palmar: can this hand hold it, and from where is it caught for certain?"""
