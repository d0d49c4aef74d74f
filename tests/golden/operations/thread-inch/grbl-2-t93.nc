(program thread-inch-2-t93, Grbl 1.1)
(part thread-inch, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(file 2 of 2, load T93 thread-unc, touch it off on the)
(stock as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T93 D 4 mm: thread-unc, thread mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: quarter: thread)
T93
G54 S10345 M3
G0 X0 Y0
G49
Z5
M8
Z1
G1 Z2.08 F620
G2 X1.175 Y0 I0.587 J0 F229
X-1.175 Y0 Z1.445 I-1.175 J0
X1.175 Y0 Z0.81 I1.175 J0
X-1.175 Y0 Z0.175 I-1.175 J0
X1.175 Y0 Z-0.46 I1.175 J0
X-1.175 Y0 Z-1.095 I-1.175 J0
X1.175 Y0 Z-1.73 I1.175 J0
X-1.175 Y0 Z-2.365 I-1.175 J0
X1.175 Y0 Z-3 I1.175 J0
X0 Y0 I-0.588 J0
G0 Z5
M9
M5
G53 G0 Z-2
M30
