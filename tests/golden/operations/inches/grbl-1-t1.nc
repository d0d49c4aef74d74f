(program inches-1-t1, Grbl 1.1)
(part inches, aluminium, 0.1575 in thick)
(stock 1.5748 x 1.1811 x 0.1575 in, from X-0.78740)
(Y-0.59055)
(origin: axis of the part, Z0 on top of the stock)
(drills go 0.0710 in below the stock: leave room under the)
(holes)
(file 1 of 3, load T1 spot-6, touch it off on the stock as)
(Z0)
(origin G54, Z0 on top of the stock, units inch and)
(inch/min)
(T1 D 0.23622 in: spot-6, spot drill)
G17 G20 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-0.07874
(operation: spot drill)
T1
G54 S3714 M3
G0 X-0.47244 Y0
G49
Z0.19686
M8
Z0.03938
G1 Z-0.05906 F8.74
G4 P0.2
G0 Z0.19686
X0.02238 Y-0.00021
Z0.03938
G1 Z-0.05906
G4 P0.2
G0 Z0.19686
M9
M5
G53 G0 Z-0.07874
M30
