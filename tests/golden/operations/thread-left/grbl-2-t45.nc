(program thread-left-2-t45, Grbl 1.1)
(part thread-left, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(file 2 of 2, load T45 thread-m6, touch it off on the)
(stock as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T45 D 4.5 mm: thread-m6, thread mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: m6: thread)
T45
G54 S9337 M3
G0 X0 Y0
G49
Z5
M8
Z1
G3 X0.75 Y0 I0.375 J0 F151
X-0.75 Y0 Z0.5 I-0.75 J0
X0.75 Y0 Z0 I0.75 J0
X-0.75 Y0 Z-0.5 I-0.75 J0
X0.75 Y0 Z-1 I0.75 J0
X-0.75 Y0 Z-1.5 I-0.75 J0
X0.75 Y0 Z-2 I0.75 J0
X-0.75 Y0 Z-2.5 I-0.75 J0
X0.75 Y0 Z-3 I0.75 J0
X0 Y0 I-0.375 J0
G0 Z5
M9
M5
G53 G0 Z-2
M30
