"""irbkin and its peers on the same poses: first what each of them finds, then how long it takes."""
